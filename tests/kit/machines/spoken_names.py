"""What CAD offices call the parts: each part of a synthetic machine renamed, in six languages, rightly and wrongly."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from yellowiron.model.assembly import Assembly, Part

LANGUAGES = ("en", "de", "fr", "es", "zh", "ja")
_SIDES = {
    "l": ("LH", "links", "gauche", "izquierdo", "左", "左"),
    "r": ("RH", "rechts", "droite", "derecho", "右", "右"),
    "": ("", "", "", "", "", ""),
}
_BARREL = ("tube", "Zylinderrohr", "fût", "camisa", "缸筒", "チューブ")
_ROD = ("rod", "Kolbenstange", "tige", "vástago", "活塞杆", "ロッド")
_LOADER = {
    "rear_frame": ("Rear Frame", "Hinterwagen", "châssis arrière", "bastidor trasero", "后车架", "リアフレーム"),
    "front_frame": ("Front Frame", "Vorderwagen", "châssis avant", "bastidor delantero", "前车架", "フロントフレーム"),
    "rear_axle": ("Rear Axle", "Hinterachse", "pont arrière", "eje trasero", "后桥", "リアアクスル"),
    "rear_wheel": ("Rear Wheel", "Rad hinten", "roue arrière", "rueda trasera", "后车轮", "後車輪"),
    "front_wheel": ("Front Wheel", "Rad vorne", "roue avant", "rueda delantera", "前车轮", "前車輪"),
    "steering": ("Steering Cyl", "Lenkzylinder", "vérin de direction", "cilindro de dirección", "转向油缸",
                 "ステアリングシリンダ"),
    "boom_cylinder": ("Lift Cylinder", "Hubzylinder", "vérin de levage", "cilindro de elevación", "动臂油缸",
                      "リフトシリンダ"),
    "bucket_cylinder": ("Tilt Cyl", "Kippzylinder", "vérin de cavage", "cilindro de volteo", "转斗油缸",
                        "バケットシリンダ"),
    "boom": ("Lift Arm", "Hubgerüst", "bras de levage", "pluma", "动臂", "ブーム"),
    "rocker": ("Bellcrank", "Umlenkhebel", "renvoi", "balancín", "摇臂", "ベルクランク"),
    "bucket_link": ("Bucket Link", "Koppelstange", "bielle", "biela", "拉杆", "リンク"),
    "bucket": ("Bucket", "Schaufel", "godet", "cucharón", "铲斗", "バケット"),
}  # fmt: skip
_EXCAVATOR = {
    "undercarriage": ("Track Frame", "Unterwagen", "châssis inférieur", "tren de rodaje", "底盘", "下部走行体"),
    "upperstructure": ("Revolving Frame", "Oberwagen", "tourelle", "superestructura", "转台", "上部旋回体"),
    "boom": ("Boom", "Ausleger", "flèche", "pluma", "动臂", "ブーム"),
    "adjust_boom": ("Intermediate Boom", "Verstellausleger", "flèche intermédiaire", "pluma intermedia", "二节臂",
                    "中間ブーム"),
    "arm": ("Stick", "Löffelstiel", "balancier", "brazo", "斗杆", "アーム"),
    "tipping_link": ("Rocker Arm", "Umlenkhebel", "biellette", "bieleta", "摇杆", "アイドラリンク"),
    "bucket_link": ("H-Link", "Koppel", "bielle", "biela", "连杆", "バケットリンク"),
    "bucket": ("Bucket", "Tieflöffel", "godet", "cucharón", "铲斗", "バケット"),
    "blade": ("Dozer Blade", "Planierschild", "lame", "hoja", "推土铲", "排土板"),
    "boom_cylinder": ("Boom Cyl", "Auslegerzylinder", "vérin de flèche", "cilindro de la pluma", "动臂油缸",
                      "ブームシリンダ"),
    "adjust_cylinder": ("Positioning Cylinder", "Verstellzylinder", "vérin de réglage", "cilindro de ajuste",
                        "调节油缸", "アジャストシリンダ"),
    "arm_cylinder": ("Stick Cylinder", "Stielzylinder", "vérin de balancier", "cilindro del brazo", "斗杆油缸",
                     "アームシリンダ"),
    "bucket_cylinder": ("Bucket Cyl", "Löffelzylinder", "vérin de godet", "cilindro del cucharón", "铲斗油缸",
                        "バケットシリンダ"),
    "blade_cylinder": ("Blade Cylinder", "Schildzylinder", "vérin de lame", "cilindro de la hoja", "推土铲油缸",
                       "ブレードシリンダ"),
}  # fmt: skip
_DETAIL = {
    "en": ("plate", "weldment", "cover", ""),
    "de": ("Blech", "Schweißteil", "Deckel", ""),
    "fr": ("tôle", "soudé", "couvercle", ""),
    "es": ("chapa", "soldado", "tapa", ""),
    "zh": ("板", "焊接件", "盖", ""),
    "ja": ("プレート", "溶接", "カバー", ""),
}


def spoken(body: str, language: str, *, kind: str) -> str | None:
    """What a body is called: `boom_cylinder_barrel_l` in German is `Hubzylinder Zylinderrohr links`; None for what no
    office has a name for here (shoes, rollers)."""
    table = _LOADER if kind == "loader" else _EXCAVATOR
    at = LANGUAGES.index(language)
    plain, _, side = re.sub(r"_(l|r)$", r" \1", body).partition(" ")
    half = None
    if plain.endswith("_cylinder_barrel"):
        plain, half = plain.removesuffix("_barrel"), _BARREL
    elif plain.endswith("_piston_rod"):
        plain, half = plain.removesuffix("_piston_rod") + "_cylinder", _ROD
    plain = "steering" if plain == "steering_cylinder" else plain
    if plain not in table:
        return None
    words = [table[plain][at], half[at] if half else "", _SIDES[side][at]]
    return ("" if language in ("zh", "ja") else " ").join(w for w in words if w)


def named(assembly: Assembly, truth: dict[str, tuple[str, str]], language: str, seed: int, *, kind: str) -> Assembly:
    """Every part called by its body, a detail and a number; shoes, hoses and the like keep a mere number."""
    rng = np.random.default_rng([seed, 41])
    parts = []
    for k, part in enumerate(assembly.parts):
        word = spoken(truth[part.id][1], language, kind=kind)
        detail = str(rng.choice(_DETAIL[language]))
        gap = "" if language in ("zh", "ja") else " "
        style = int(rng.integers(3))
        name = f"{word}{gap if detail else ''}{detail}" if word else f"PRT{k:04d}"
        if word and style == 1:
            name = f"{name}-{k:02d}"
        elif word and style == 2:
            name = re.sub(r"\s+", "_", name).upper()
        parts.append(replace(part, name=name))
    return replace(assembly, parts=tuple(parts))


def _renamed(assembly: Assembly, names: Sequence[str]) -> Assembly:
    parts = [replace(p, name=n) for p, n in zip(assembly.parts, names, strict=True)]
    return replace(assembly, parts=tuple(parts))


def mistyped(assembly: Assembly, rng: np.random.Generator) -> Assembly:
    """One letter of every long word swapped with the next, left out or doubled, in half of the words."""

    def typo(match: re.Match[str]) -> str:
        word = match.group()
        if rng.random() < 0.5:
            return word
        at = int(rng.integers(1, len(word) - 1))
        how = int(rng.integers(3))
        if how == 0:
            return word[:at] + word[at + 1] + word[at] + word[at + 2 :]
        return word[:at] + word[at + 1 :] if how == 1 else word[:at] + word[at] + word[at:]

    return _renamed(assembly, [re.sub(r"[^\W\d_\u3040-\u9fff]{5,}", typo, p.name) for p in assembly.parts])


def truncated(assembly: Assembly, rng: np.random.Generator, *, length: int = 10) -> Assembly:
    """As an old system cuts them."""
    return _renamed(assembly, [p.name[:length] for p in assembly.parts])


def shuffled(assembly: Assembly, rng: np.random.Generator, *, share: float = 1.0) -> Assembly:
    """A share of the names dealt out anew among their parts."""
    chosen = [k for k in range(len(assembly.parts)) if rng.random() < share]
    names = [p.name for p in assembly.parts]
    for k, other in zip(chosen, rng.permutation(chosen).tolist(), strict=True):
        names[k] = assembly.parts[other].name
    return _renamed(assembly, names)


_SWAPS = (("LH", "RH"), ("Rear", "Front"), ("REAR", "FRONT"), ("tube", "rod"), ("TUBE", "ROD"), ("Lift", "Tilt"),
          ("LIFT", "TILT"), ("Boom", "Stick"), ("BOOM", "STICK"))  # fmt: skip


def misleading(assembly: Assembly, rng: np.random.Generator) -> Assembly:
    """English names that tell the opposite: left is right, front is rear, tubes are rods, the boom is the stick."""
    names = []
    for part in assembly.parts:
        name = part.name
        for a, b in _SWAPS:
            name = name.replace(a, "\0").replace(b, a).replace("\0", b)
        names.append(name)
    return _renamed(assembly, names)


def in_assemblies(assembly: Assembly, rng: np.random.Generator) -> Assembly:
    """The names on the assemblies, the parts numbered."""
    parts = [Part(p.id, f"Solid{k}", ("MACHINE", p.name), p.shape, p.transform) for k, p in enumerate(assembly.parts)]
    return replace(assembly, parts=tuple(parts))
