"""Completions of bash, zsh and fish, from what the program says of itself.

After `endoflow` come commands, after `run` engines, then options; behind --set and --vary the parameters' keys, for CASE the
names of cases and files, elsewhere files.
"""

#: Options whose value begins with a parameter's key.
WITH_KEYS = ("--set", "--vary", "--continue-in")

HEAD = "Made by tools/manual from the program; do not edit."


def names_of(command):
    """All names of a command's options."""
    return [name for option in command["options"] for name in option["names"]]


def takes_case(command):
    """Whether a command's first place is a case."""
    return any(option["value"].startswith("CASE") for option in command["options"] if not option["names"])


def first_words(commands):
    """The commands, each once."""
    return [*dict.fromkeys(words[0] for words in commands), "help"]


BASH = r"""# bash completion for endoflow. {head}
_endoflow()
{{
    local current previous command
    COMPREPLY=()
    current=${{COMP_WORDS[COMP_CWORD]}}
    previous=${{COMP_WORDS[COMP_CWORD-1]}}
    command=${{COMP_WORDS[1]}}
    if [[ $COMP_CWORD -eq 1 ]]; then
        COMPREPLY=($(compgen -W "{first}" -- "$current"))
        return
    fi
    if [[ $command = run && $COMP_CWORD -eq 2 ]]; then
        COMPREPLY=($(compgen -W "{engines}" -- "$current"))
        return
    fi
    case $previous in
    {keyed})
        COMPREPLY=($(compgen -S = -W "{keys}" -- "$current"))
        compopt -o nospace
        return ;;
    esac
    if [[ $current = -* ]]; then
        case $command in
{options}
        esac
        return
    fi
    case $command in
    {with_case})
        COMPREPLY=($(compgen -W "{cases}" -- "$current")) ;;
    help)
        COMPREPLY=($(compgen -W "{first}" -- "$current")) ;;
    params)
        COMPREPLY=($(compgen -W "{sections}" -- "$current")) ;;
    esac
    COMPREPLY+=($(compgen -f -- "$current"))
    compopt -o filenames
}}
complete -F _endoflow endoflow
"""


def bash(commands, parameters, cases):
    """The file for bash."""
    options = {}
    for words, command in commands.items():
        options.setdefault(words[0], dict.fromkeys(names_of(command)))
    lines = [f'        {word}) COMPREPLY=($(compgen -W "{" ".join(names)}" -- "$current")) ;;' for word, names in options.items()]
    keys = [row["name"] for row in parameters]
    return BASH.format(
        head=HEAD,
        first=" ".join(first_words(commands)),
        engines=" ".join(words[1] for words in commands if len(words) > 1),
        keyed=" | ".join(WITH_KEYS),
        keys=" ".join(keys),
        options="\n".join(lines),
        with_case=" | ".join(dict.fromkeys(words[0] for words, command in commands.items() if takes_case(command))),
        cases=" ".join(cases),
        sections=" ".join(dict.fromkeys(key.rsplit(".", 1)[0] for key in keys)),
    )


def quoted(text):
    """Text between single quotes of a shell, on one line."""
    return "'" + " ".join(text.split()).replace("'", "'\\''") + "'"


def described(text):
    """Text for zsh's descriptions."""
    return " ".join(text.split()).replace("[", "(").replace("]", ")").replace(":", ",")


def zsh(commands, parameters, cases):
    """The file for zsh."""
    text = f"#compdef endoflow\n# {HEAD}\nlocal -a keys cases\nkeys=({' '.join(row['name'] + '=' for row in parameters)})\ncases=({' '.join(cases)})\n"
    text += "local -a commands\ncommands=(\n"
    firsts = {}
    for words, command in commands.items():
        firsts.setdefault(words[0], command["description"] if len(words) == 1 else "Runs a case with an engine")
    text += "".join(f"  {quoted(word + ':' + described(about))}\n" for word, about in firsts.items())
    text += ")\nif (( CURRENT == 2 )); then\n  _describe command commands\n  return\nfi\ncase $words[2] in\n"
    for word in firsts:
        own = [command for words, command in commands.items() if words[0] == word][0]
        text += f"{word})\n"
        if word == "run":
            engines = " ".join(words[1] for words in commands if words[0] == "run")
            text += f"  if (( CURRENT == 3 )); then compadd {engines}; return; fi\n"
        text += "  _arguments \\\n"
        for option in own["options"]:
            action = "compadd -S \"\" -a keys" if set(option["names"]) & {*WITH_KEYS} else "_files"
            value = f":{described(option['value'])}:{action if action == '_files' else '{' + action + '}'}" if option["value"] else ""
            for name in option["names"]:
                text += f"    {quoted('*' + name + '[' + described(option['help']) + ']' + value)} \\\n"
        rest = "{compadd -a cases; _files}" if takes_case(own) else "_files"
        text += f"    {quoted('*:file:' + rest)}\n  ;;\n"
    return text + "esac\n"


def fish(commands, parameters, cases):
    """The file for fish."""
    firsts = " ".join(first_words(commands))
    text = f"# {HEAD}\nset -l commands {firsts}\n"
    text += f"set -l keys {' '.join(row['name'] + '=' for row in parameters)}\n"
    for word in first_words(commands):
        about = next((c["description"] for w, c in commands.items() if w == (word,)), "")
        text += f"complete -c endoflow -n \"not __fish_seen_subcommand_from $commands\" -f -a {word} -d {quoted(about)}\n"
    engines = [words[1] for words in commands if len(words) > 1]
    text += f"complete -c endoflow -n \"__fish_seen_subcommand_from run; and not __fish_seen_subcommand_from {' '.join(engines)}\" -f -a {quoted(' '.join(engines))}\n"
    seen = set()
    for words, command in commands.items():
        if words[0] in seen:
            continue
        seen.add(words[0])
        condition = f'-n "__fish_seen_subcommand_from {words[0]}"'
        if takes_case(command):
            behind = f"; and __fish_seen_subcommand_from {' '.join(engines)}" if words[0] == "run" else ""
            text += f"complete -c endoflow {condition[:-1]}{behind}\" -a {quoted(' '.join(cases))} -d 'case'\n"
        for option in command["options"]:
            if not option["names"]:
                continue
            flags = " ".join(f"-l {n[2:]}" if n.startswith("--") else f"-s {n[1:]}" for n in option["names"])
            value = ""
            if option["value"]:
                value = " -x -a \"$keys\"" if set(option["names"]) & {*WITH_KEYS} else " -r"
            text += f"complete -c endoflow {condition} {flags}{value} -d {quoted(option['help'])}\n"
    return text
