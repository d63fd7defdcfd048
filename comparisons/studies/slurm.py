"""The batch script that runs a sweep's members as a Slurm array."""

import shlex
from pathlib import Path

from comparisons.errors import BAD_INPUT, StudyError
from comparisons.files import write_text
from comparisons.studies.members import FINISHED, program, run_command, work_left

TEMPLATE = r"""#!/bin/bash
# Runs {count} member(s) of a sweep as an array:   sbatch {script}
# Options of sbatch may be added there, such as --time, --partition or --account. Submitting it again continues what was
# interrupted and leaves out what is finished. Afterwards the command that wrote this file collects the results.
#SBATCH --job-name={name}
#SBATCH --array=0-{last}{limit}
#SBATCH --nodes=1
#SBATCH --ntasks={processes}
#SBATCH --cpus-per-task=1
#SBATCH --chdir={working_directory}
#SBATCH --output={logs}
set -u
endoflow=${{ENDOFLOW_PROGRAM:-{program}}}
script={script}
export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1

# run fresh|continue DIRECTORY COMMAND…: what this script's earlier jobs left there decides, else the first word.
run() {{
    local work=$1 directory=$2 state
    shift 2
    if [[ $directory/run.json -nt $script ]]; then
        state=$(sed -n 's/^ *"state": *"\([a-z]*\)".*/\1/p' "$directory/run.json" | head -n 1)
        work=fresh
        case $state in
        finished) echo "$directory: finished already"; exit 0 ;;
        running | interrupted) [[ -n $(compgen -G "$directory/checkpoint/*.h5") ]] && work=continue ;;
        esac
    fi
    [[ $work = continue ]] && set -- "$@" --restart
    exec "$@"
}}

case ${{SLURM_ARRAY_TASK_ID:?submit this script with sbatch}} in
{entries}
*) echo "no member $SLURM_ARRAY_TASK_ID" >&2; exit 2 ;;
esac
"""


def write_script(members, name, script, processes, jobs):
    """Write the script (Path) that runs what is left of members; returns what to tell the user.

    name: of the job; processes: of each member; jobs: most members at a time, None for no limit. Raises StudyError for paths
    that a line of the script cannot hold.
    """
    left = [(work, member) for member in members if (work := work_left(member)) != FINISHED]
    if not left:
        return f"all {len(members)} runs are finished: nothing to submit"
    logs = f"{directive(script.parent, '-o').replace('%', '%%')}/slurm-%A_%a.txt"
    text = TEMPLATE.format(
        count=len(left),
        last=len(left) - 1,
        limit="" if jobs is None else f"%{jobs}",
        name=f'"{directive(name, "the case file")}"',
        script=shlex.quote(str(script)),
        logs=f'"{logs}"',
        working_directory=f'"{directive(Path.cwd(), "the working directory")}"',
        program=shlex.quote(str(program())),
        processes=processes,
        entries="\n".join(_entry(number, *entry, processes) for number, entry in enumerate(left)),
    )
    write_text(script, text)
    return f"{len(left)} of {len(members)} runs left: sbatch {script}; afterwards the same command with --collect"


def directive(text, what):
    """Text (or a path) for between double quotes in a line that starts with #SBATCH.

    Raises StudyError where such a line cannot hold it: a line break ends it, a double quote the text, and a backslash in a
    file's name switches sbatch's patterns off.
    """
    text = str(text)
    if not text.isprintable() or set(text) & set('\\"'):
        raise StudyError(
            f"{what}: {text!r} cannot stand in a batch script; choose a name without line breaks, quotes and backslashes",
            BAD_INPUT,
        )
    return text


def _entry(number, work, member, processes):
    """One member's line."""
    command = run_command('"$endoflow"', member, "", processes)
    words = [word if word == '"$endoflow"' else shlex.quote(word) for word in command]
    return f"{number}) run {work} {shlex.quote(str(member.directory))} {' '.join(words)} ;;"
