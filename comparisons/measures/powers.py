"""Powers of ten as people write them."""

import re

SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def with_powers(text):
    """Text of a number, "1.2e-07" as "1.2·10⁻⁷"."""
    return re.sub(r"e([+-]\d+)$", lambda found: f"·10{str(int(found[1])).translate(SUPERSCRIPTS)}", text)
