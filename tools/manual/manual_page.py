"""endoflow.1 in the language of man(7), from what the program says of itself."""

EXIT_CODES = (
    ("0", "done"),
    ("2", "bad command line or case file"),
    ("3", "the solver stopped, or a run of a study failed"),
    ("4", "input or output"),
    ("129, 130, 143", "ended by SIGHUP, SIGINT or SIGTERM, with a checkpoint to continue from"),
)

FILES = (
    ("run.json", "parameters, versions, host, events, alarms"),
    ("history.csv", "one row for each accepted step"),
    ("shapes.h5", "the membrane at output times"),
    ("fields.pvd, fields/", "velocity and pressure for ParaView"),
    ("checkpoint/", "what a restart needs"),
)


def escaped(text):
    """Text that troff prints as it is."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\\&" + text if text.startswith((".", "'")) else text


def entry(head, body):
    """A tagged paragraph; head is ready troff."""
    return f".TP\n{head}\n{escaped(body)}\n"


def usage(command):
    """One line of a command's synopsis."""
    words = " ".join(f"\\fB{escaped(word)}\\fR" for word in command["command"].split())
    places = [option for option in command["options"] if not option["names"]]
    named = [option for option in command["options"] if option["names"] and option["required"]]
    parts = [f"\\fI{escaped(option['value'])}\\fR" for option in places]
    parts += [f"\\fB{escaped(option['names'][-1])}\\fR \\fI{escaped(option['value'])}\\fR" for option in named]
    return f".br\n{' '.join([words, *parts])} [options]\n"


def option_head(option):
    """Names and value of an option."""
    if not option["names"]:
        return f"\\fI{escaped(option['value'])}\\fR"
    names = ", ".join(f"\\fB{escaped(name)}\\fR" for name in option["names"])
    return f"{names} \\fI{escaped(option['value'])}\\fR" if option["value"] else names


def page(commands, parameters, version):
    """The page's text. commands, parameters: as of described."""
    text = f'.\\" Made by tools/manual from the program; do not edit.\n.TH ENDOFLOW 1 "" "endoflow {version}" "User commands"\n'
    text += ".SH NAME\nendoflow \\- endocytosis in viscous fluid, computed by two independent engines\n.SH SYNOPSIS\n"
    text += "".join(usage(command) for command in commands.values()).removeprefix(".br\n")
    text += ".SH DESCRIPTION\n" + escaped(
        "A coated patch of membrane between two viscous fluids bends into a bud. The engine boundary-integral computes it with a "
        "sharp membrane, phase-field with a diffuse one. A case is a TOML file, or the name of one that comes with the program. Every run "
        "has a directory of its own."
    )
    text += "\n.SH COMMANDS\n"
    for words, command in commands.items():
        text += f".SS {escaped('endoflow ' + ' '.join(words))}\n{escaped(command['description'])}\n"
        for option in command["options"]:
            choices = f" One of {', '.join(option['choices'])}." if option["choices"] else ""
            text += entry(option_head(option), option["help"] + choices)
    text += ".SH PARAMETERS\n" + escaped("Keys of a case file and of --set, with their defaults. `endoflow params` says more.") + "\n"
    for row in parameters:
        unit = f" {row['unit']}" if row["unit"] else ""
        text += entry(f"\\fB{escaped(row['name'])}\\fR = {escaped(str(row['default']))}{escaped(unit)}", row["meaning"])
    text += ".SH EXIT STATUS\n" + "".join(entry(f"\\fB{escaped(code)}\\fR", meaning) for code, meaning in EXIT_CODES)
    text += ".SH FILES\n" + escaped("In a run's directory:") + "\n"
    text += "".join(entry(f"\\fI{escaped(name)}\\fR", meaning) for name, meaning in FILES)
    return text
