"""Labels that list several properties: "bore x stroke" for a product, "laden / unladen" for numbers with a slash."""

from __future__ import annotations

import re

from yellowiron.specs.language.vocabulary import GENERAL, OPPOSITES, tokens
from yellowiron.specs.layout.statement import joined

_CROSS = re.compile(
    r"\s+[x×✕*/]\s+|\s*[×✕]\s*|\s+(?:&|and|und|et|y)\s+"
    r"(?=stroke|rod|Hub|course|carrera|width|thickness|length|height)",
    re.IGNORECASE,
)
COUNTED_PARTS = re.compile(
    r"(?:\b(?:number|no\.?|quantity|qty\.?) of (?:cylinders?|units)\b|\bAnzahl(?: der)? \w+\b|\bnombre de \w+\b|"
    r"\bnúmero de \w+\b|\b(?:number|no\.|qty\.?|quantity|anzahl|nombre|número|n[º°])(?=\s*[-–—x×])|"
    r"(?:本数|数量|个数)(?=\s*[-–—－x×]))\s*(?:[-–—－,:/x×]\s*)?",
    re.IGNORECASE,
)
_LWH, _SEL = ("length", "width", "height"), ("thickness", "width", "length")
_SIZES = dict.fromkeys(("LBH", "LlH", "LAH", "LAhA", "LAnAl", "lbh", "长宽高", "長幅高"), _LWH) | {"sel": _SEL}
_INITIALS = {"l": "length", "w": "width", "a": "width", "b": "width", "h": "height", "t": "thickness", "e": "thickness"}
_FORK_SIZES = re.compile(r"(?<!\S)s\s?/\s?e\s?/\s?l(?!\S)")
"""What makers call length × width × height, and VDI 2198 a fork's measures."""
_TIGHT = re.compile(r"\s?(?<![^\W\d])L\s?[x×*]\s?W\s?[x×*]\s?H(?![^\W\d])", re.IGNORECASE)
_LISTED = re.compile(r"\(([^\W\d][^(),]*(?:,\s*[^\W\d][^(),]*)+)\)")
"""Names in brackets with commas between them: "Forks (thickness, width, length)"."""
_OFF = re.compile(r"\((?:without|w/o|excl\S*|less) forks?\)", re.IGNORECASE)
"""What is left off for the length says nothing of the width and the height."""
_NAME = r"(?:(?:length|longueur|longitud|di[aá]m\w+|diamètre) (?:of|de|du|del) \S+|\S+(?:\s+(?:diameter|dia\.?))?)"
"""What one factor of a product is called: "bore", "rod diameter", "length of stroke"."""


def enumerated(label: str, count: int) -> list[str]:
    """The properties a label lists for a product of `count` factors, each with the words before the list.

    ("Lift cylinders – bore x stroke", 2) → ["Lift cylinders bore", "Lift cylinders stroke"]; [] if it lists others.
    """
    bare = _FORK_SIZES.sub("s × e × l", COUNTED_PARTS.sub(" ", label)).strip()
    bare = _LISTED.sub(lambda m: f"({m.group(1).replace(',', ' × ')})", _TIGHT.sub(" L × W × H", bare))
    parts = [p.strip(" ()[]") for p in _CROSS.split(bare)]
    if len(parts) != count or not all(re.search(r"[^\W\d_]", p) for p in parts):
        return []
    first = re.match(rf"^(.*[-–—,:(]|.*?)\s*({_NAME})$", parts[0])
    prefix, name = (first.group(1), first.group(2)) if first else ("", parts[0])
    if re.search(r"[-–—,:(]$", prefix.strip()):
        name = re.split(r"[-–—,:(]\s*", parts[0])[-1] or name
    prefix = prefix.strip(" -–—,:(")
    last = re.match(rf"^({_NAME})(.*)$", parts[-1])
    suffix = last.group(2).strip() if last else ""
    parts[-1] = last.group(1) if last else parts[-1]
    names = [name, *parts[1:]]
    initials = [_INITIALS.get(n.casefold(), "") for n in names]
    names = list(_SIZES.get("".join(names), initials if all(initials) else names))
    if any("stroke" in tokens(n) for n in names):  # "diameter × stroke" of a cylinder
        names = ["bore" if tokens(n) == ("diameter",) else n for n in names]
    if tuple(names) == _LWH and frozenset(tokens(prefix)) <= GENERAL:  # of nothing else than the machine
        prefix = f"overall {prefix}"
    across = _OFF.sub(" ", prefix)
    return [" ".join(f"{prefix if n == 'length' else across} {n} {suffix}".split()) for n in names]


def alternatives(label: str, count: int) -> list[str]:
    """The labels of `count` numbers with slashes between them, from one that names them alike; [] if it does not.

    ("Axle load, front/rear", 2) → ["Axle load, front", "Axle load, rear"]; the list may stand in brackets, behind the
    last comma, or be a word of the label.
    """
    for pattern in _LISTS:
        for match in reversed(list(pattern.finditer(label))):  # "tilt of mast/carriage, forward/backward"
            parts = [part.strip() for part in re.split(r"[/／]", match.group(1))]
            if len(parts) == 2 and parts[0].casefold() in _WITH and (load := _LACKING.sub("", parts[1])) != parts[1]:
                parts[0] = joined([parts[0], load.strip()])  # "with/without load"
            symbols = all(re.fullmatch(r"[α-ωa-z]\d{0,2}", part) for part in parts) and "".join(parts) not in _LETTERS
            if len(parts) != count or symbols or not all(re.search(r"[^\W\d]", part) for part in parts):
                continue
            if tokens(parts[-1]) == ("empty",) and tokens(parts[0]) == ("maximum",):
                parts[0] = "loaded"  # "full/empty"
            names = _LETTERS.get("".join(parts), _with_shared(parts))
            return [f"{label[: match.start(1)]}{name}{label[match.end(1) :]}" for name in names]
    return []


def opposed(label: str) -> list[str]:
    """The labels of one number that holds for two opposites, both of which its label names: "Track front/rear"; [] for
    other labels."""
    first, second = (frozenset(tokens(own)) for own in alternatives(label, 2) or ("", ""))
    apart = any(OPPOSITES.get(word, frozenset()) & (second - first) for word in first - second)
    return alternatives(label, 2) if apart else []


def standard_of_two(label: str) -> list[str]:
    """The label of one number under what names the standard and something else: "Overall width, standard / dual" is
    the standard's; [] for other labels."""
    first, second = alternatives(label, 2) or ("", "")
    return [first] if "standard" in set(tokens(first)) - set(tokens(second)) else []


def _with_shared(parts: list[str]) -> list[str]:
    """Two alternatives, of which the second is one word: what stands before its opposite holds for both
    ("backwards laden", "unladen")."""
    before, _, last = parts[0].rpartition(" ")
    other = frozenset(tokens(parts[-1]))
    opposite = len(other) == 1 and any(OPPOSITES.get(word, frozenset()) & other for word in tokens(last))
    return [parts[0], f"{before} {parts[-1]}"] if len(parts) == 2 and before and opposite else parts


_WITH = ("with", "mit", "avec", "con", "有", "带")
_LACKING = re.compile(r"^(?:without\b|ohne\b|sans\b|sin\b|无|不带|w/o)", re.IGNORECASE)
_LETTERS = {"sel": list(_SEL), "se": list(_SEL[:2])}
_LISTS = (
    re.compile(r"[(（\[]([^()（）\[\]]*[/／][^()（）\[\]]*)[)）\]]"),
    re.compile(r"[,，、:：–—-]\s*([^,，、:：–—]*[/／][^,，、:：–—]*)$"),
    re.compile(r"([前後后左右上下]{1,2}(?:[/／][前後后左右上下]{1,2})+)$"),
    re.compile(r"((?<!\S)(?:with|mit|avec|con)[/／](?:without|ohne|sans|sin) \S+)$", re.IGNORECASE),
    re.compile(r"(?<!\S)((?:en|à|con|mit|avec) \S+ ?[/／] ?(?:en|à|con|sin|ohne|sans) \S+)$", re.IGNORECASE),
    re.compile(r"(?<!\S)(\S+(?:[/／]\S+)+)"),
    re.compile(r"(?<!\S)(\S+(?:\s[/／]\s\S+)+)"),
)
