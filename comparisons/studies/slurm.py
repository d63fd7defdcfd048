"""The batch script that runs a sweep's members as a Slurm array."""

import shlex

from comparisons.errors import BAD_INPUT, StudyError

TEMPLATE = r"""#!/bin/bash
# Runs {count} member(s) of a sweep as an array:   sbatch {script}
# Options of sbatch may be added there, such as --time, --partition or --account. Submitting it again continues what was
# interrupted and leaves out what is finished. Afterwards the command that wrote this file collects the results.
#SBATCH --job-name={name}
#SBATCH --array=0-{last}{limit}
#SBATCH --nodes=1
#SBATCH --ntasks={processes}
#SBATCH --cpus-per-task={threads}
#SBATCH --chdir={working_directory}
#SBATCH --output={logs}
set -u
endoflow=${{ENDOFLOW_PROGRAM:-{program}}}
script={script}
export OMP_NUM_THREADS={threads} OPENBLAS_NUM_THREADS={threads}

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


def array_script(entries, name, script, working_directory, program, processes, threads, jobs):
    """Text of the script.

    entries: [(work, directory, command line)] of the members to run; a command line is a list of str whose program is
    "$endoflow". script, working_directory, program: paths; processes of each member, threads of each process;
    jobs: most members at a time, None for no limit. Raises StudyError for paths that a line of the script cannot hold.
    """
    logs = f"{directive(script.parent, '-o').replace('%', '%%')}/slurm-%A_%a.txt"
    return TEMPLATE.format(
        count=len(entries),
        last=len(entries) - 1,
        limit="" if jobs is None else f"%{jobs}",
        name=f'"{directive(name, "the case file")}"',
        script=shlex.quote(str(script)),
        logs=f'"{logs}"',
        working_directory=f'"{directive(working_directory, "the working directory")}"',
        program=shlex.quote(str(program)),
        processes=processes,
        threads=threads,
        entries="\n".join(_entry(number, *entry) for number, entry in enumerate(entries)),
    )


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


def _entry(number, work, directory, command):
    """One member's line."""
    words = [word if word == '"$endoflow"' else shlex.quote(word) for word in command]
    return f"{number}) run {work} {shlex.quote(str(directory))} {' '.join(words)} ;;"
