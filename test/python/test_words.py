"""One word per idea, as doc/terminology.md says: what is kept or held in another sense than a
contact has another name."""

import io
import pathlib
import re
import tokenize
import unittest

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
NO_CODE = re.compile(r"//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\])*\"", re.DOTALL)
WORD = re.compile(r"kept|Kept|keep(?![a-z])|Keep|(?<![a-z])held|Held")


def names_of_cpp(text):
    return re.findall(r"\w+", NO_CODE.sub(" ", text))


def names_of_python(text):
    return [
        token.string
        for token in tokenize.generate_tokens(io.StringIO(text).readline)
        if token.type == tokenize.NAME
    ]


def unfit(names):
    return sorted({name for name in names if WORD.search(name)})


class WordsTest(unittest.TestCase):
    def test_nothing_is_called_kept_or_held(self):
        found = {}
        for folder, pattern, names in (
            ("src", "*.[hc]pp", names_of_cpp),
            ("include", "*.hpp", names_of_cpp),
            ("python", "*.py", names_of_python),
        ):
            for path in sorted((REPOSITORY / folder).rglob(pattern)):
                words = unfit(names(path.read_text(encoding="utf-8")))
                if words:
                    found[str(path.relative_to(REPOSITORY))] = words
        self.assertEqual(found, {})

    def test_the_check_sees_names_and_no_texts(self):
        self.assertEqual(
            unfit(
                names_of_cpp(
                    'int kept_; // is kept\nconst char* text = "held"; HeldState s; '
                    "keepIt(threshold, keeper);"
                )
            ),
            ["HeldState", "keepIt", "kept_"],
        )
        self.assertEqual(
            unfit(names_of_python("_kept = 'held'  # held\nshield = withheld = 1\n")), ["_kept"]
        )


if __name__ == "__main__":
    unittest.main()
