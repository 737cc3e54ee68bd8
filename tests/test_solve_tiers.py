"""Which program answers: one that compiles quickly outside of programs, an optimised one where it was asked for."""

import sys

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import jaxbearing as jb
from jaxbearing.numerics.compiling import inside_a_program

SCENE = jb.load_scene("reference_roller", {"contact": "none"})
SOLVE = sys.modules["jaxbearing.solve"]


def loss(speed):
    return jb.solve(SCENE.at_operation(inner_speed=speed), throw=False).ring.radial


def unvarying(speed):
    """The scene does not depend on the traced number: it is part of the program all the same."""
    return speed * jb.solve(SCENE, throw=False).ring.radial


@pytest.fixture
def calls(monkeypatch):
    """Names of the programs that answered."""
    made = []
    for name in ("_solve", "_solve_quickly", "_solve_differentiated", "_solve_optimised"):
        real = getattr(SOLVE, name)
        monkeypatch.setattr(SOLVE, name, lambda *args, real=real, name=name: (made.append(name), real(*args))[1])
    return made


def test_which_program_answers(calls):
    """Of a batch `_solve_differentiated` asks `_solve` (`tests/programs/test_differentiated.py`)."""
    for call, program in (
        (lambda: jb.solve(SCENE), "_solve_quickly"),
        (lambda: jb.solve(SCENE, optimised=True), "_solve_optimised"),
        (lambda: jax.jit(loss)(900.0), "_solve"),
        (lambda: jax.jit(unvarying)(900.0), "_solve"),
        (lambda: jax.vmap(loss)(jnp.array([900.0, 950.0])), "_solve_differentiated"),
        (lambda: jax.grad(loss)(900.0), "_solve_differentiated"),
        (lambda: jax.jacfwd(loss)(900.0), "_solve_differentiated"),
    ):
        calls.clear()
        call()
        assert calls[0] == program


@pytest.mark.usefixtures("optimized")
def test_both_programs_agree():
    quick, slow = jb.solve(SCENE), jb.solve(SCENE, optimised=True)
    assert bool(quick.converged)
    for one, other in zip(jax.tree.leaves(quick), jax.tree.leaves(slow), strict=True):
        # sums of loads that balance, and last residuals, are rounding
        np.testing.assert_allclose(one, other, rtol=1e-9, atol=1e-12, equal_nan=True)


def test_what_is_inside_a_program():
    seen = []
    look = lambda x: (seen.append(inside_a_program(0.0)), x)[1]
    look(1.0)
    jax.jit(look)(1.0)
    jax.grad(look)(1.0)
    assert seen == [False, True, False]
    jax.grad(lambda x: (seen.append(inside_a_program([x])), x)[1])(1.0)
    assert seen[-1]


def test_compile_report_counts_what_a_scene_needs():
    """A part that is left out adds no line; numbers change nothing."""
    dry = jb.compile_report(SCENE, compile=False)
    again = jb.compile_report(SCENE.at_operation(inner_speed=12.0), compile=False)
    rated = jb.compile_report(SCENE.replace({"rating": jb.Rating()}), compile=False)
    assert dry[:2] == again[:2]
    assert dry.equations < rated.equations
    assert dry.lines < rated.lines
    assert (dry.optimised, dry.quick) == (None, None)
    with pytest.raises(TypeError, match="cannot solve a dict"):
        jb.compile_report({})


def test_quick_compile_options_compile_any_program():
    options = jb.quick_compile_options()
    slope = jax.jit(jax.grad(loss), compiler_options=options)
    np.testing.assert_allclose(slope(900.0), jax.grad(loss)(900.0), rtol=1e-9)


def test_compile_report_compiles_in_both_ways():
    report = jb.compile_report(jb.load_scene("two_disk_etm"))
    assert report.tracing > 0.0
    assert min(report.optimised, report.quick) > 0.0
