"""How a solve ended: one enumeration for the solver, the Python result, the JSON and the screen."""

import enum


class Status(enum.IntEnum):
    """Outcome of a solve, carried as an integer array so that every lane of a batch has its own."""

    CONVERGED = 0
    NOT_CONVERGED = 1
    DIVERGED = 2
    NO_EQUILIBRIUM = 3

    @property
    def text(self) -> str:
        """`converged`, `not_converged`, `diverged` or `no_equilibrium`."""
        return self.name.lower()


class SolveError(RuntimeError):
    """A solve that did not converge; the message names status, residual and worst equation."""
