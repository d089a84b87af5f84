"""The sets in words of their own are true: each printed number stands on a page, each label names one thing."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import pytest

from kit.sheets import FURTHER, WORDED, cases, make, page_texts
from kit.sheets.worded import lines


@pytest.mark.parametrize("split", list(WORDED))
@pytest.mark.slow
def test_each_printed_number_stands_on_a_page(split: str, tmp_path: Path) -> None:
    own = cases(split)
    kinds = {case.kind for case in own}
    if split in FURTHER:
        assert len(kinds) == 4 and len({case.layout for case in own}) >= 4 and len(own) == 12
    else:
        assert len(kinds) == 10 and len({case.layout for case in own}) >= 6 and len(own) >= 40
        assert all(sum(case.kind == kind for case in own) >= 7 for kind in ("wheel_loader", "excavator"))
    printed = 0
    for case in own[:: 1 if split in FURTHER else 6]:
        sheet = make(case, tmp_path)
        text = "".join(page_texts(sheet.path).values())
        printed += len(sheet.truth)
        for name, number in sheet.printed.items():  # type: ignore[attr-defined]
            bare = "".join(number.split())
            assert bare in text or bare.replace(".", "") in text, (sheet.path.name, name, number)
    assert printed > 200


@pytest.mark.parametrize("split", list(WORDED))
def test_no_label_names_two_things_in_a_section(split: str) -> None:
    parts = lines(WORDED[split].file)
    for kind in WORDED[split].plan:
        own = [one for one in parts[kind] if not one.name.startswith("@")]
        extra = [one for one in parts["distractors"] if one.place.split(",")[0] == "all" or kind in one.place]
        for language in own[0].words:
            for wording in (0, 1):
                seen = Counter(
                    (section, words[min(wording, len(words) - 1)].casefold())
                    for section, words in [
                        *((one.place, one.words[language]) for one in own),
                        *((one.name, one.words[language]) for one in extra),
                    ]
                )
                twice = [key for key, count in seen.items() if count > 1 and key[1] != "-"]
                assert twice == [], (kind, language)
