"""`endoflow run ENGINE CASE.toml --certify`: a run, and the more accurate ones that tell how accurate it is.

The run lies in DIR as ever, the others in DIR/certify/; run.json gets `certificate`. Exit codes: 0 done; 2 bad command
line or parameter; 3 a run failed; 4 input or output; 130 or 143 interrupted (run it again to continue).
"""

import json
import os
import sys
from pathlib import Path

from comparisons.errors import IO_FAILURE, RUN_FAILED, StudyError
from comparisons.files import shown, write_json
from comparisons.studies.study import lock, program, report_failures, run_members

from .options import case_parser, common_settings


def parsed(arguments):
    """The command line as a namespace: ENGINE, then what `endoflow run ENGINE` takes."""
    parser = case_parser("run ENGINE", "Run a case and certify its numbers.")
    parser.add_argument("engine", choices=("boundary-integral", "phase-field"))
    parser.add_argument("--certify", action="store_true", help="what brought you here")
    parser.add_argument("--restart", action="store_true", help="no matter: what is there is continued in any case")
    # The engine stands in front of the case.
    return parser.parse_args([*arguments[1:], *arguments[:1]])


def base_member(options, output):
    """The run to certify, a members.Member."""
    from comparisons.studies.members import Member, resolved_parameters

    settings = tuple(common_settings(options))
    parameters = resolved_parameters(program(), options.case, settings)
    return Member("run", options.case, output, options.engine, settings, {}, parameters)


def refined_members(member):
    """The runs that certify a finished one."""
    from comparisons.studies.members import Member, read_record, resolved_parameters
    from comparisons.studies.refined_runs import denser_settings, finer_settings, thinner_settings

    notes = read_record(member.directory).get("notes", {})
    wanted = {"finer": finer_settings(member.engine, member.parameters, notes)}
    if member.engine == "phase-field":
        wanted["thinner"] = thinner_settings(member.parameters)
    else:
        wanted["denser"] = denser_settings(member.parameters, notes)
    members = []
    for name, changes in wanted.items():
        settings = (*member.settings, *changes)
        parameters = resolved_parameters(program(), member.case, settings)
        directory = member.directory / "certify" / name
        members.append(Member(name, member.case, directory, member.engine, settings, {}, parameters))
    return members


def write_certificate(member, refined):
    """Put the certificate into the run's run.json; returns it."""
    import endoflow
    from comparisons.measures.certificate import certificate, layer_parts, sharp_parts
    from comparisons.studies.refined_runs import THICKNESS_RATIO

    runs = {other.name: endoflow.load(other.directory) for other in refined}
    run = endoflow.load(member.directory)
    if member.engine == "phase-field":
        parts = layer_parts(run, runs["finer"], runs["thinner"], THICKNESS_RATIO)
    else:
        parts = sharp_parts(run, runs["denser"], runs["finer"])
    found = certificate(run, parts)
    found["runs"] = {other.name: str(other.directory.relative_to(member.directory)) for other in refined}
    path = member.directory / "run.json"
    record = json.loads(path.read_text(encoding="utf-8"))
    record["certificate"] = found
    beside = path.with_suffix(".json.new")
    write_json(beside, record)
    os.replace(beside, path)
    return found


def run(options):
    """Run the command; returns its exit code."""
    from comparisons.measures.certificate import in_words
    from comparisons.studies.member_runner import Interruption

    output = options.output or Path("out") / options.case.stem / options.engine
    member = base_member(options, output)
    with lock(output / "certify"):
        with Interruption() as interruption:
            refined = []
            outcomes = run_members([member], options, interruption)
            if not interruption.signal and not report_failures("run", outcomes):
                refined = refined_members(member)
                outcomes = run_members(refined, options, interruption)
        if interruption.signal:
            print("endoflow run: interrupted; the same command continues", file=sys.stderr)
            return 128 + interruption.signal
        if not refined or report_failures("run", outcomes):
            return RUN_FAILED
        found = write_certificate(member, refined)
    for entry in found["values"].values():
        print(f"{entry['title']:<14} {in_words(entry)}")
    if not found["values"]:
        raise StudyError(f"{output}: the runs share no quantity that could be certified", IO_FAILURE)
    print(f"results in {shown(output)}, what certifies them in {shown(output / 'certify')}")
    return 0
