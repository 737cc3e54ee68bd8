"""Quick compilation with whatever options a jaxlib knows; thresholds of the collector of garbage come back."""

import gc
import threading

import jax.numpy as jnp
import pytest

from jaxbearing.numerics import compiling
from jaxbearing.numerics.compiling import quickly_compiled
from jaxbearing.numerics.garbage import RARELY, rare_garbage_collection

USUAL = (700, 10, 10)


@pytest.fixture
def usual_collector():
    before = gc.get_threshold()
    gc.set_threshold(*USUAL)
    yield
    gc.set_threshold(*before)


def test_an_option_that_jaxlib_does_not_know_is_left_out(monkeypatch):
    known = compiling.quick_options.__wrapped__()
    assert known
    monkeypatch.setattr(compiling, "_QUICK", {**known, "xla_no_such_option": True})
    assert compiling.quick_options.__wrapped__() == known
    assert float(quickly_compiled(lambda x: 2.0 * x)(jnp.asarray(3.0))) == 6.0


@pytest.mark.usefixtures("usual_collector")
def test_thresholds_are_set_once_and_come_back():
    with rare_garbage_collection():
        assert gc.get_threshold() == RARELY
        with rare_garbage_collection():
            assert gc.get_threshold() == RARELY
        assert gc.get_threshold() == RARELY
    assert gc.get_threshold() == USUAL


@pytest.mark.usefixtures("usual_collector")
def test_the_last_thread_sets_them_back():
    inside, leave = threading.Event(), threading.Event()

    def other():
        with rare_garbage_collection():
            inside.set()
            leave.wait(10.0)

    thread = threading.Thread(target=other)
    with rare_garbage_collection():
        thread.start()
        assert inside.wait(10.0)
    assert gc.get_threshold() == RARELY
    leave.set()
    thread.join()
    assert gc.get_threshold() == USUAL
    with pytest.raises(ZeroDivisionError), rare_garbage_collection():
        1 / 0  # noqa: B018
    assert gc.get_threshold() == USUAL
