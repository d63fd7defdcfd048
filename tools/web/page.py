#!/usr/bin/env python3
"""page.py ENGINE.wasm OUTPUT.html: the laboratory as one file, made of web/page/, the engine and the cases."""

import base64
import json
import pathlib
import re
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPTS = ("engine", "settings", "stage", "charts", "panel", "files", "tour", "laboratory")

# Cases that the page's engine runs, and what they are called there; the others belong to another engine or to a study.
CASES = {
    "standard": "The standard case",
    "fickian": "Molecules that diffuse",
    "geometric": "No fluid",
    "asymptotic": "A smooth edge",
    "statics": "A coat too small to bud",
    "tube": "A bare membrane under tension",
    "line-tension": "An edge that costs",
    "growing-coat": "A coat that grows",
    "maturing-coat": "A coat that matures",
    "actin": "Actin that pulls at a coat",
    "closed_vesicle": "A vesicle in free fluid",
}


def preset(name, title):
    """One entry of the page's list of cases."""
    text = (ROOT / "cases" / f"{name}.toml").read_text(encoding="utf-8")
    tomllib.loads(text)
    return {"name": name, "title": title, "text": text}


def as_script(value):
    """JSON that may stand inside a <script>."""
    return json.dumps(value, ensure_ascii=False).replace("</", "<\\/")


def page(engine):
    """The page's text; `engine`: bytes of the WebAssembly module."""
    source = ROOT / "web" / "page"
    read = {path.name: path.read_text(encoding="utf-8") for path in source.iterdir()}
    parts = {
        "style.css": read["style.css"],
        "worker": as_script(read["worker.js"]),
        "wasm": as_script(base64.b64encode(engine).decode()),
        "presets": as_script([preset(*case) for case in CASES.items()]),
        "script": "\n".join(read[f"{name}.js"].replace('"use strict";\n', "", 1) for name in SCRIPTS),
    }
    return re.sub(r"/\*\{([\w.]+)\}\*/", lambda match: parts[match[1]], read["index.html"])


def main():
    engine, output = map(pathlib.Path, sys.argv[1:])
    output.parent.mkdir(parents=True, exist_ok=True)
    output.write_text(page(engine.read_bytes()), encoding="utf-8")
    print(f"{output}: {output.stat().st_size / 1e6:.2f} MB")


if __name__ == "__main__":
    main()
