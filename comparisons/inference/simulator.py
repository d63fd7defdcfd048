"""Runs of a problem, kept in its directory: the same point is run once, also by a later call of the command."""

import hashlib

import numpy as np

import endoflow
from comparisons.errors import RUN_FAILED, StudyError
from comparisons.inference.course import CourseError, course_of
from comparisons.inference.study_file import horizon
from comparisons.studies.member_runner import FAILED, Task, available_cores, member_environment, run_all, shares
from comparisons.studies.members import FINISHED, Member, resolved_parameters, run_command, work_left
from comparisons.studies.progress import Progress

#: Shapes that a run writes up to its end when contours are data.
SHAPES = 60


class Interrupted(Exception):
    """A signal stopped the runs; the same command continues."""

    def __init__(self, number):
        super().__init__(number)
        self.number = number


class Simulator:
    """Courses of a Problem's runs in directory/runs.

    jobs, processes: as of every study; interruption: an entered member_runner.Interruption.
    """

    def __init__(self, problem, program, directory, jobs, processes, interruption):
        self.problem, self.program, self.directory = problem, program, directory / "runs"
        self.jobs, self.processes, self.interruption = jobs, processes, interruption
        self.courses_by_name, self.points, self.members, self.failures = {}, {}, {}, {}
        self.alarmed, self.total = {}, 0

    def member(self, point):
        """The Member of engine coordinates (engine_count,), its parameters checked."""
        own = self.problem.settings(point)
        study = self.problem.study
        settings = (*fixed_settings(study, self.problem.parameters), *(f"{key}={text}" for key, text in own.items()))
        name = hashlib.sha1("\n".join((study.engine, *settings)).encode()).hexdigest()[:12]
        if name not in self.members:
            parameters = resolved_parameters(self.program, study.case, settings)
            self.members[name] = Member(name, study.case, self.directory / name, study.engine, settings, own, parameters)
        return self.members[name]

    def courses(self, points):
        """The Course of each point (n, engine_count), None where a run failed; runs what is not there yet, in parallel.

        Raises Interrupted; StudyError when every run failed.
        """
        members = [self.member(point) for point in points]
        wanted = {member.name: member for member in members if member.name not in self.courses_by_name}
        self._run([member for member in wanted.values() if work_left(member) != FINISHED])
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

    def stop_if_interrupted(self):
        """Raises Interrupted after a signal."""
        if self.interruption.signal:
            raise Interrupted(self.interruption.signal)

    def _run(self, members):
        if not members:
            return
        of_mpi = self.processes if self.problem.study.engine == "phase-field" else 1
        parallel, threads = shares(available_cores(), self.jobs, of_mpi)
        mpirun = ("mpirun", "--bind-to", "none") if parallel > 1 else ("mpirun",)
        tasks = [Task(m, run_command(self.program, m, work_left(m), self.processes, mpirun)) for m in members]
        progress = Progress(tasks, 0, parallel)
        outcomes = run_all(tasks, parallel, member_environment(threads), progress, self.interruption)
        progress.finish()
        self.total += len(members)
        self.stop_if_interrupted()
        self.failures.update({name: outcome.message for name, outcome in outcomes.items() if outcome.state == FAILED})

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
    shapes = end / SHAPES if study.contours else end
    own = {
        "output.field_interval": "0",
        "output.shape_interval": f"{shapes:.10g}",
        "output.stop_at_budding": "true",
        "time.end": f"{end:.10g}",
    }
    return settings_of({**own, **study.settings})


def settings_of(values):
    """("section.key=value", …) of {key: value}."""
    return tuple(f"{key}={str(value).lower() if isinstance(value, bool) else value}" for key, value in values.items())

