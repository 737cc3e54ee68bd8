"""Status of a solve: one enumeration for the solver, the Python result, the JSON and the screen."""

import enum


class Status(enum.IntEnum):
    """Outcome of a solve, carried as an integer array so that every lane of a batch has its own."""

    CONVERGED = 0
    NOT_CONVERGED = 1
    DIVERGED = 2
    NO_EQUILIBRIUM = 3
    INVALID_INPUT = 4
    """A traced number is out of its bound: `checks` names the rule."""
    OUTSIDE_VALIDITY = 5
    THERMAL_RUNAWAY = 6

    @property
    def text(self) -> str:
        """The name in lower case, e.g. `not_converged`."""
        return self.name.lower()


class SolveError(RuntimeError):
    """A solve that did not converge; the message names status, residual and worst equation."""

    def __init__(self, message: str, status: Status = Status.NOT_CONVERGED):
        super().__init__(message)
        self.status = status
