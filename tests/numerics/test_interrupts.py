"""Ctrl-C that waits for the end of a block: in Python, where nobody else listens."""

import signal
import threading

import pytest

from jaxbearing.numerics.interrupts import deferred_interrupts, is_the_command, listening, note_interrupt


@pytest.fixture(autouse=True)
def _listening():
    """Tests started in the background of a shell may ignore Ctrl-C."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    signal.signal(signal.SIGINT, before)


def test_it_waits_for_the_end():
    done = []

    def block():
        with deferred_interrupts() as interrupt:
            signal.raise_signal(signal.SIGINT)
            assert interrupt.seen
            done.append("the rest of the block")

    with pytest.raises(KeyboardInterrupt):
        block()
    assert done


def test_who_deals_with_it_goes_on():
    with deferred_interrupts() as interrupt:
        signal.raise_signal(signal.SIGINT)
        interrupt.taken()
    assert interrupt.seen


def test_the_second_one_does_not_wait():
    done = []

    def block():
        with deferred_interrupts():
            signal.raise_signal(signal.SIGINT)
            done.append("first")
            signal.raise_signal(signal.SIGINT)
            done.append("second")

    with pytest.raises(KeyboardInterrupt):
        block()
    assert done == ["first"]


def test_one_inside_another():
    """The inner block's Ctrl-C ends the outer one too, unless it is dealt with."""
    with pytest.raises(KeyboardInterrupt), deferred_interrupts() as outer, deferred_interrupts():
        signal.raise_signal(signal.SIGINT)
    assert not outer.seen


def test_other_threads_and_ignored_signals_are_left_alone():
    seen = []

    def inside():
        with deferred_interrupts():
            seen.append(signal.getsignal(signal.SIGINT))

    thread = threading.Thread(target=inside)
    thread.start()
    thread.join()
    assert seen == [signal.default_int_handler]
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    with deferred_interrupts() as interrupt:
        signal.raise_signal(signal.SIGINT)
    assert not interrupt.seen
    signal.signal(signal.SIGINT, signal.default_int_handler)


def test_another_thread_that_hears_it_first():
    """What it tells counts once; Python's handler, which comes later, changes nothing."""
    assert not note_interrupt()

    def block():
        with listening(), deferred_interrupts() as interrupt:
            signal.raise_signal(signal.SIGINT)
            assert not interrupt.seen
            assert note_interrupt()
            assert interrupt.seen
            # the second one is not waited with
            assert not note_interrupt()

    with pytest.raises(KeyboardInterrupt):
        block()


@pytest.mark.parametrize(
    ("words", "command"),
    [
        (["python", "/usr/bin/jaxbearing", "solve"], True),
        (["python", "-X", "dev", "-m", "jaxbearing", "solve"], True),
        (["python", "-m", "pytest", "jaxbearing"], False),
        (["python", "-c", "import jaxbearing"], False),
        (["python", "script.py", "jaxbearing"], False),
        (["python"], False),
    ],
)
def test_which_processes_are_the_command(words, command, monkeypatch):
    monkeypatch.setattr("sys.orig_argv", words)
    assert is_the_command() is command
