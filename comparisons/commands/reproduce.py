"""`endoflow reproduce ITEM [--quick|--full] [-o DIR] [--jobs N]`: the paper's figures and tables, ours beside them.

ITEM is table2, fig3, fig4, fig5, fig6, fig7, figA2; mobility, attribution, timescale or inertia, which ask why ours differ;
all; or of other papers hassinger2017, derenyi2002, juelicher1996, which are branches of stationary shapes and need seconds. The runs lie in DIR/runs and are shared by the items; each item writes DIR/ITEM with report.html, plots (PNG, SVG) and ITEM.csv; DIR/index.html lists them,
DIR/runs.csv the runs with state, CPU time and an estimate of what is left. Exit codes: 0 done,
also when an engine refused a run: its item's page says so; 2 bad command line or parameter; 3 nothing ran; 4 input or output; 130 or
143 interrupted (run it again to continue).
"""

import hashlib
import sys
from dataclasses import replace
from pathlib import Path

from comparisons import ROOT
from comparisons.errors import RUN_FAILED, StudyError
from comparisons.files import shown, write_text
from comparisons.studies.study import lock, program, run_members

from .options import study_parser

NAMES = ("table2", "fig3", "fig4", "fig5", "fig6", "fig7", "figA2", "mobility", "attribution", "timescale", "inertia")

#: Bytes; programs and archives append words of their own.
LONGEST_NAME = 200

#: Items of other papers, which `all` leaves out.
OTHER_NAMES = ("hassinger2017", "derenyi2002", "juelicher1996")


def parsed(arguments):
    """The command line as a namespace."""
    parser = study_parser("reproduce", "Reproduce figures and tables of the paper.", "out/paper")
    names = (*NAMES, "all", *OTHER_NAMES)
    parser.add_argument("items", metavar="ITEM", nargs="+", choices=names, help=", ".join(names))
    extent = parser.add_mutually_exclusive_group()
    extent.add_argument("--quick", action="store_true", help="few and short phase-field runs: all in half an hour")
    extent.add_argument("--full", action="store_true", help="the paper's layer and times (the default); many hours")
    parser.add_argument(
        "--engine", choices=("boundary-integral", "phase-field", "both"), default="both", help="default: %(default)s"
    )
    parser.add_argument("--until", metavar="T", type=float, help="no run goes on longer than this, µs")
    parser.add_argument("--pages-only", action="store_true", help="run nothing: write the pages from the runs there are")
    return parser.parse_args(arguments)


def directory_of(wanted, settings):
    """Relative directory of a run: case and settings, then the engine; runs with equal ones are one run."""
    from comparisons.studies.members import directory_name

    words = [wanted.case, *([directory_name(settings).replace("/", ",")] if settings else [])]
    return Path("runs") / short_enough(",".join(words)) / wanted.engine


def short_enough(name):
    """A file's name that file systems take, which end at 255 bytes: a long one ends in a digest of the whole."""
    if len(name.encode()) <= LONGEST_NAME:
        return name
    digest = hashlib.sha256(name.encode()).hexdigest()[:12]
    return f"{name.encode()[: LONGEST_NAME - 13].decode(errors='ignore')},{digest}"


def own_settings(options):
    """{section.key: text} of the command line's --set."""
    from comparisons.studies.ranges import RangeError

    pairs = [text.partition("=") for text in options.set]
    bad = [key for key, equals, _ in pairs if not equals or key.count(".") != 1]
    if bad:
        raise RangeError(f"--set {bad[0]}: it must read section.key=value")
    return {key: value for key, _, value in pairs}


def study_members(options, output):
    """What is to be run: ({(item, name, engine): member name}, {member name: members.Member or item.NotRun}).

    A member's name is None where its engine was not asked for.
    """
    from comparisons.paper import ITEMS, OTHERS

    asked, ends, first = {}, {}, {}
    for item in chosen(options):
        for wanted in {**ITEMS, **OTHERS}[item].wanted(options.quick):
            if options.engine not in (wanted.engine, "both"):
                asked[item, wanted.name, wanted.engine] = None
                continue
            settings = {**wanted.settings, **own_settings(options)}
            directory = directory_of(wanted, settings)
            name = str(directory.relative_to("runs"))
            asked[item, wanted.name, wanted.engine] = name
            end = wanted.end if options.until is None else min(wanted.end, options.until)
            ends[name] = max(end, ends.get(name, 0.0))
            first.setdefault(name, (replace(wanted, settings=settings), output / directory))
    return asked, {name: checked_member(name, *first[name], ends[name]) for name in first}


def checked_member(name, wanted, directory, end):
    """The members.Member of a run, or item.NotRun with what is wrong with its parameters.

    A run that is there and went on longer is taken as it is.
    """
    from comparisons.paper.item import NotRun
    from comparisons.studies.members import Member, differing_parameters, read_record, resolved_parameters

    case = ROOT / "cases" / f"{wanted.case}.toml"

    def member_to(time):
        settings = (*(f"{key}={value}" for key, value in wanted.settings.items()), f"time.end={time:.12g}")
        parameters = resolved_parameters(program(), case, settings)
        return Member(name, case, directory, wanted.engine, settings, wanted.settings, parameters)

    try:
        member = member_to(end)
        record = read_record(directory)
        if record and differing_parameters(record["parameters"], member.parameters, wanted.engine) == ["time.end"]:
            member = member_to(max(end, record["parameters"]["time"]["end"]))
        return member
    except StudyError as error:
        return NotRun(str(error))


def chosen(options):
    """The items asked for, in the paper's order, then those of other papers."""
    own = NAMES if "all" in options.items else [name for name in NAMES if name in options.items]
    return [*own, *(name for name in OTHER_NAMES if name in options.items)]


def loaded(members, outcomes):
    """{member name: endoflow.Run or item.NotRun}."""
    import endoflow
    from comparisons.paper.item import NotRun
    from comparisons.studies.cost import expected_seconds
    from comparisons.studies.members import differing_parameters, read_record
    from comparisons.studies.progress import duration

    found = {}
    for name, member in members.items():
        if isinstance(member, NotRun):
            found[name] = member
            continue
        outcome = outcomes.get(name)
        if outcome is None and read_record(member.directory) is None:
            estimate = duration(expected_seconds(member, member.end))
            found[name] = NotRun(f"not run yet, about {estimate} for one core")
            continue
        try:
            run = endoflow.load(member.directory)
        except endoflow.EndoflowError as error:
            found[name] = NotRun(outcome.message if outcome and outcome.message else str(error))
            continue
        differs = differing_parameters(run.parameters, member.parameters, member.engine)
        failed = outcome is not None and outcome.state == "failed"
        message = outcome.message if failed else f"{member.directory} holds a run with other parameters"
        found[name] = NotRun(message) if differs or (failed and len(run.shapes) < 2) else run
    return found


def runs_of(item, asked, found):
    """{name: {engine: endoflow.Run or item.NotRun}} of an item."""
    runs = {}
    for (owner, name, engine), member in asked.items():
        if owner == item:
            engines = runs.setdefault(name, {})
            if member is not None:
                engines[engine] = found[member]
    return runs


def not_run(found):
    """{member name: reason} of those without a run."""
    from comparisons.paper.item import is_run

    return {name: one.reason for name, one in found.items() if not is_run(one)}


def write_item(item, runs, options, output):
    """Write an item's directory; returns its paper.item.Result."""
    from comparisons.drawing.plots import save
    from comparisons.paper import ITEMS, OTHERS, page
    from comparisons.studies.sweep_table import write_table

    module = {**ITEMS, **OTHERS}[item]
    source = getattr(module, "SOURCE", page.SOURCE)
    directory = output / item
    directory.mkdir(parents=True, exist_ok=True)
    result = module.result(runs, options.quick)
    write_table(directory / f"{item}.csv", result.rows)
    for name, (_, figure) in result.figures.items():
        save(figure, directory, name)
    text = page.item_html(item, module.TITLE, source, result, runs, options.quick, directory)
    write_text(directory / "report.html", text)
    return result


def run(options):
    """Run the command; returns its exit code."""
    from comparisons.paper import page, run_table  # with matplotlib, before the runs
    from comparisons.studies.member_runner import Interruption
    from comparisons.studies.members import Member
    from comparisons.studies.sweep_table import write_table

    output = options.output or Path("out/paper")
    asked, members = study_members(options, output)
    with lock(output):
        with Interruption() as interruption:
            runnable = [member for member in members.values() if isinstance(member, Member)]
            outcomes = {} if options.pages_only else run_members(runnable, options, interruption)
        if interruption.signal:
            print("endoflow reproduce: interrupted; the same command continues", file=sys.stderr)
            return 128 + interruption.signal
        found = loaded(members, outcomes)
        for name, reason in not_run(found).items():
            print(f"endoflow reproduce: {name}: not run: {reason}", file=sys.stderr)
        for item in chosen(options):
            result = write_item(item, runs_of(item, asked, found), options, output)
            print("\n".join(page.summary_lines(item, result, output / item)))
        if members:  # branches of stationary shapes are no runs
            write_table(output / "runs.csv", run_table.rows(members))
        write_text(output / "index.html", page.index_html(output))
        print(f"pages   {shown(output / 'index.html')}")
    return RUN_FAILED if found and len(not_run(found)) == len(found) else 0
