"""`SceneError`, the error for scenes that cannot be read: file, field, what was found, what is expected, nearest name.

One error reports all problems of a file. The module `problems` makes it from errors of pydantic and of classes. Every
command imports this module, so it must be quick to import.
"""

import difflib
from collections.abc import Iterable, Sequence

from .words import shortened


class MeanUsedWarning(UserWarning):
    """A scene was read with the mean, or the median, of a field that is given as a distribution."""


class PresetUsedWarning(UserWarning):
    """A preset (`laws = "best"` in a scene file) supplied laws of a scene, and perhaps estimated dimensions."""


class SceneError(ValueError):
    """A scene cannot be read or does not make sense. The message has one line for each problem.

    **Arguments:**
    - `file`: name of the file or of the built-in scene.
    - `path`: dotted path of the field; empty if the problem concerns the whole file.
    - `found`, `expected`: actual and expected content of the field, in words.
    - `suggestion`: nearest valid name; may be empty.
    - `reason`: reason for the expectation, in words; may be empty.
    - `others`: the other problems, each a `SceneError`.
    """

    def __init__(
        self,
        file: str,
        path: str,
        found: str,
        expected: str,
        suggestion: str = "",
        reason: str = "",
        others: Iterable["SceneError"] = (),
    ):
        self.file, self.path, self.found, self.expected = file, path, found, expected
        self.suggestion, self.reason, self.others = suggestion, reason, tuple(others)
        super().__init__(self._message())

    @staticmethod
    def of_all(problems: Sequence["SceneError"]) -> "SceneError":
        """One error that holds all these problems; it is the first of them, the others follow in `others`."""
        every = [problem for error in problems for problem in error.problems]
        return every[0]._with(every[1:])

    @property
    def problems(self) -> tuple["SceneError", ...]:
        """All problems, this one first, each as an error of its own."""
        return (self._with(()), *self.others)

    def of(self, file: str) -> "SceneError":
        """The same error with another name of the file."""
        words = (self.path, self.found, self.expected, self.suggestion, self.reason)
        return SceneError(file, *words, others=self.others)

    def inside(self, above: str) -> "SceneError":
        """The same error with a longer path, of a table inside the table at `above`."""
        path = f"{above}.{self.path}".rstrip(".")
        words = (self.found, self.expected, self.suggestion, self.reason)
        return SceneError(self.file, path, *words, others=[other.inside(above) for other in self.others])

    def _with(self, others: Iterable["SceneError"]) -> "SceneError":
        words = (self.file, self.path, self.found, self.expected, self.suggestion, self.reason)
        return SceneError(*words, others=others)

    def _message(self) -> str:
        if not self.others:
            return self._sentence()
        problems = self.problems
        # if all problems are in one file, its name stands once
        name = f"{printable(self.file)}: " if len({problem.file for problem in problems}) == 1 else ""
        lines = [problem._sentence().removeprefix(name) for problem in problems]
        return "\n  - ".join([f"{name}{len(lines)} problems:", *lines])

    def _sentence(self) -> str:
        place = f"{self.file}: {shortened(self.path)}" if self.path else self.file
        text = f"{place}: found {self.found}; expected {self.expected}"
        text += f" ({self.reason})." if self.reason else "."
        if self.suggestion:
            text += f" Did you mean '{self.suggestion}'?"
        return printable(" ".join(text.split()))


class StatesUnusedWarning(UserWarning):
    """A scene was read from a file with a load spectrum, whose states it leaves out."""


def printable(text: str) -> str:
    """A text for a terminal, with unprintable characters (escape sequences, null bytes) escaped as in Python code."""
    return "".join(char if char.isprintable() else repr(char)[1:-1] for char in text)


def nearest(name: str, valid: Iterable[str]) -> str:
    """The valid name with the most similar spelling; empty if none is similar."""
    by_lower = {candidate.lower(): candidate for candidate in valid}
    close = difflib.get_close_matches(name.lower(), by_lower, n=1, cutoff=0.6)
    return by_lower[close[0]] if close else ""


_MOST_NAMES, _MOST_LETTERS = 24, 340
"""Longest list of names that a message prints in full, in names and in letters."""


def one_of(names: Iterable[str]) -> str:
    """Valid names in words: "'a'", or "one of 'a', 'b'". Of a long list only the first three and the last are named."""
    quoted = [f"'{name}'" for name in names]
    if len(quoted) > _MOST_NAMES or len(", ".join(quoted)) > _MOST_LETTERS:
        return f"one of {', '.join(quoted[:3])}, ..., {quoted[-1]} ({len(quoted)} words)"
    return quoted[0] if len(quoted) == 1 else "one of " + ", ".join(quoted)
