"""Text files that people give, from whatever program: what they say, or what they are instead of text."""

import codecs
import io
import re
import stat

#: Encodings that may be named; what begins with a byte-order mark says its own.
ENCODINGS = ("utf-8", "latin-1")

#: Byte-order marks, the longer ones first: that of UTF-32 begins like that of UTF-16.
MARKS = (
    (codecs.BOM_UTF8, "utf-8"),
    (codecs.BOM_UTF32_LE, "utf-32-le"),
    (codecs.BOM_UTF32_BE, "utf-32-be"),
    (codecs.BOM_UTF16_LE, "utf-16-le"),
    (codecs.BOM_UTF16_BE, "utf-16-be"),
)

#: What files begin with that are no text.
SIGNATURES = (
    (b"PK\x03\x04", "a workbook (.xlsx, .ods) or another zip archive"),
    (b"\xd0\xcf\x11\xe0", "a workbook of an old kind (.xls)"),
    (b"\x89HDF", "an HDF5 file"),
    (b"\x1f\x8b", "a compressed file"),
    (b"BZh", "a compressed file"),
    (b"\xfd7zXZ", "a compressed file"),
    (b"%PDF", "a PDF"),
    (b"\x89PNG", "a picture"),
    (b"\xff\xd8\xff", "a picture"),
    (b"II*\x00", "a picture"),
    (b"MM\x00*", "a picture"),
)

#: Largest file that is read: a table of a million rows.
MOST_BYTES = 64 * 2**20

#: Longest path that a message shows whole.
LONGEST = 400


class FileError(ValueError):
    """A file that cannot be read as text; the message begins with its path."""


def read_text(path, remedy, encoding="utf-8", recoding="save it in UTF-8"):
    """The text of a file (Path) without byte-order mark, each line ended by one newline.

    encoding: one of ENCODINGS; remedy: what to give instead of a file that is no text; recoding: what to do about text in
    another encoding. Raises FileError.
    """
    content = _bytes(path, remedy)
    for mark, own in MARKS:
        if content.startswith(mark):
            content, encoding = content[len(mark) :], own
            break
    else:
        for signature, what in SIGNATURES:
            if content.startswith(signature):
                raise FileError(f"{path}: is {what}; {remedy}")
        if b"\0" in content:
            raise FileError(f"{path}: holds zero bytes, which no text in UTF-8 does; {remedy}")
    try:
        text = content.decode(encoding)
    except UnicodeDecodeError as error:
        line = len(re.split(rb"\r\n|\r|\n", content[: error.start]))
        byte = f"the byte 0x{content[error.start]:02x} is no text in {encoding.upper()}"
        raise FileError(f"{path}:{line}: {byte}; {recoding}") from None
    if "\0" in text:
        raise FileError(f"{path}: holds zero bytes, which no text does; {remedy}")
    return io.StringIO(text, newline=None).read()


def _bytes(path, remedy):
    """What a file holds."""
    try:
        kind = path.stat()
        if stat.S_ISDIR(kind.st_mode):
            raise FileError(f"{path}: is a directory; {remedy}")
        if not stat.S_ISREG(kind.st_mode):
            raise FileError(f"{path}: is no file but a pipe or a device; {remedy}")
        if kind.st_size > MOST_BYTES:
            raise FileError(f"{path}: has {kind.st_size / 2**20:.0f} MiB, more than {MOST_BYTES >> 20}; {remedy}")
        return path.read_bytes()
    except OSError as error:
        name = str(path) if len(str(path)) <= LONGEST else f"{str(path)[:LONGEST]}…"
        raise FileError(f"{name}: {error.strerror}; {remedy}") from None
    except ValueError as error:
        if isinstance(error, FileError):
            raise
        raise FileError(f"{str(path)!r}: is no path of a file; {remedy}") from None
