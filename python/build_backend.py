"""Makes the wheel of this package for pip (PEP 517, PEP 660). The package is pure Python: copying it needs no other package,
so `pip install` works without network.
"""

import base64
import hashlib
import tomllib
import zipfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
PACKAGE = "endoflow"

WHEEL = "Wheel-Version: 1.0\nGenerator: build_backend\nRoot-Is-Purelib: true\nTag: py3-none-any\n"


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """Write the wheel into a directory; returns its file name."""
    return _write(wheel_directory, {f"{PACKAGE}/{file.name}": file.read_bytes() for file in _sources()})


def build_editable(wheel_directory, config_settings=None, metadata_directory=None):
    """Write a wheel that leads here (`pip install --editable`); returns its file name."""
    return _write(wheel_directory, {f"{PACKAGE}.pth": f"{HERE}\n".encode()})


def build_sdist(sdist_directory, config_settings=None):
    """There is none: the source tree of endoflow is one."""
    raise NotImplementedError("no source archive is made of this directory alone; take that of endoflow")


def _sources():
    """The package's files."""
    return sorted(file for file in (HERE / PACKAGE).iterdir() if file.suffix == ".py" or file.name == "py.typed")


def _write(directory, contents):
    """Write contents {path: bytes} and what describes them as a wheel; returns its file name."""
    project = tomllib.loads((HERE / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    name = f"{project['name']}-{project['version']}"
    about = f"{name}.dist-info"
    files = {**contents, f"{about}/METADATA": metadata(project).encode(), f"{about}/WHEEL": WHEEL.encode()}
    files[f"{about}/RECORD"] = "".join(_record(path, data) for path, data in files.items()).encode() + f"{about}/RECORD,,\n".encode()
    wheel = f"{name}-py3-none-any.whl"
    with zipfile.ZipFile(Path(directory) / wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, data in files.items():
            archive.writestr(path, data)
    return wheel


def metadata(project):
    """The METADATA of pyproject.toml's [project]."""
    lines = ["Metadata-Version: 2.1", f"Name: {project['name']}", f"Version: {project['version']}"]
    lines += [f"Summary: {project['description']}", f"License: {project['license']['text']}"]
    lines += [f"Requires-Python: {project['requires-python']}"]
    lines += [f"Requires-Dist: {needed}" for needed in project["dependencies"]]
    for extra, needs in project["optional-dependencies"].items():
        lines += [f"Provides-Extra: {extra}", *(f'Requires-Dist: {needed}; extra == "{extra}"' for needed in needs)]
    return "\n".join(lines) + "\n"


def _record(path, data):
    """A line of RECORD."""
    digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
    return f"{path},sha256={digest},{len(data)}\n"
