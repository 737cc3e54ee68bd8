"""Status of a solve. Solvers, Python results, JSON and the screen share this enumeration."""

import enum


class Status(enum.IntEnum):
    """Outcome of a solve. Results hold it as an integer array, so that every lane (member of a batch) has its own."""

    CONVERGED = 0
    NOT_CONVERGED = 1
    """The steps ran out, or a nested solve failed."""
    DIVERGED = 2
    """A value was not finite, or a transient run needed a step below the smallest one that is allowed."""
    NO_EQUILIBRIUM = 3
    """There is no steady state: no position balances the loads, or there is too little entrainment for a film."""
    INVALID_INPUT = 4
    """Numbers that JAX traces break a rule, which `checks` or the failure message names. A known number that breaks one
    raises `ValueError` before the solve."""
    OUTSIDE_VALIDITY = 5
    """A law does not describe this operating point."""
    THERMAL_RUNAWAY = 6
    """Temperatures rise beyond their limit: friction heats a part faster than it is cooled."""

    @property
    def text(self) -> str:
        """The name in lower case, such as `not_converged`."""
        return self.name.lower()


class SolveError(RuntimeError):
    """A solve or a transient run failed; the message gives the status and the reason, where known."""

    def __init__(self, message: str, status: Status = Status.NOT_CONVERGED):
        super().__init__(message)
        self.status = status
