"""Runs of a problem, kept in its directory: the same point is run once, also by a later call of the command."""

import hashlib

import numpy as np

import endoflow
from comparisons.errors import RUN_FAILED, StudyError
from comparisons.inference.course import CourseError, course_of
from comparisons.inference.study_file import horizon
from comparisons.studies.member_runner import FAILED
from comparisons.studies.members import FINISHED, checked_member, resolved_parameters, settings_of, work_left

#: Shapes that a run writes up to its end when contours or pits are data.
SHAPES = 60

#: A fraction of a prior that gives no whole number: a parameter that must be one is no unknown.
WITHIN = 0.381966


class Simulator:
    """Courses of a Problem's runs in the directory `runs` of a studies.study.Study, which runs them."""

    def __init__(self, problem, study):
        self.problem, self.study, self.directory = problem, study, study.output / "runs"
        self.courses_by_name, self.points, self.members = {}, {}, {}
        #: {member name: message} of runs that failed, and of those that left the bounds of an accurate run.
        self.failures, self.alarmed = {}, {}

    def member(self, point):
        """The Member of engine coordinates (engine_count,), its parameters checked."""
        own, study = self.problem.settings(point), self.problem.study
        settings = (*fixed_settings(study, self.problem.parameters), *settings_of(own))
        name = hashlib.sha1("\n".join((study.engine, *settings)).encode()).hexdigest()[:12]
        if name not in self.members:
            self.members[name] = checked_member(name, study.case, self.directory / name, study.engine, settings, own)
        return self.members[name]

    def courses(self, points):
        """The Course of each point (n, engine_count), None where a run failed; runs what is not there yet, in parallel.

        Raises study.Interrupted; StudyError when every run failed.
        """
        members = [self.member(point) for point in points]
        wanted = {member.name: member for member in members if member.name not in self.courses_by_name}
        if left := [member for member in wanted.values() if work_left(member) != FINISHED]:
            outcomes = self.study.run(left)
            self.failures.update({name: outcome.message for name, outcome in outcomes.items() if outcome.state == FAILED})
        self.points.update(zip((member.name for member in members), points))
        for member in wanted.values():
            self.courses_by_name[member.name] = self._course(member)
        if len(self.failures) > 2 and len(self.failures) == len(self.courses_by_name):
            name, message = next(iter(self.failures.items()))
            raise StudyError(f"every run failed, {self.directory / name} with: {message}", RUN_FAILED)
        return [self.courses_by_name[member.name] for member in members]

    def pool(self):
        """(points (n, engine_count), Courses) of all that is known."""
        return np.array([self.points[name] for name in self.courses_by_name]), [*self.courses_by_name.values()]

    def _course(self, member):
        """The Course of a finished member; None, and a failure noted, for one that cannot be read."""
        if member.name in self.failures:
            return None
        try:
            run = endoflow.load(member.directory)
            if run.alarms:
                self.alarmed[member.name] = str(run.alarms[0])
            return course_of(run.until(member.end), self.problem.columns, self.problem.contours)
        except (endoflow.EndoflowError, CourseError) as error:
            self.failures[member.name] = str(error)
            return None


def fixed_settings(study, parameters):
    """Settings of every run of a StudyFile: no fields, few shapes, an end at budding or well after the last datum."""
    end = horizon(study, parameters)
    shapes = end / SHAPES if study.contours or study.pits else end
    own = {
        "output.field_interval": "0",
        "output.shape_interval": f"{shapes:.10g}",
        "output.stop_at_budding": "true",
        "time.end": f"{end:.10g}",
    }
    return settings_of({**own, **study.settings})


def resolved(study, settings=()):
    """Parameters of a StudyFile's case with its own and other settings. Raises StudyError that begins with the study's path."""
    try:
        return resolved_parameters(study.case, [*settings_of(study.settings), *settings])
    except StudyError as error:
        raise StudyError(f"{study.path}: {error}", error.exit_code) from None


def check_limits(problem):
    """Raises StudyError where a run at a limit of an unknown's prior or within it, the others in their middle, is refused."""
    priors = problem.priors[: problem.engine_count]
    middle = np.array([prior.from_fraction(0.5) for prior in priors])
    for number, prior in enumerate(priors):
        for tried in (prior.lowest, prior.highest, prior.from_fraction(WITHIN)):
            point = middle.copy()
            point[number] = tried
            try:
                resolved(problem.study, settings_of(problem.settings(point)))
            except StudyError as error:
                said = str(error).removeprefix(f"{problem.study.path}: ")
                what = f"its prior allows {float(prior.value(tried)):.6g}, but {said}"
                raise StudyError(f"{problem.study.path}: unknown {problem.names[number]}: {what}", error.exit_code) from None
