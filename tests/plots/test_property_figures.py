"""Property figures draw the package's laws, in engineer's units."""

import numpy as np
import pytest

from jaxbearing import plots


def test_film_of_figure_28():
    """0.624 um at 100 degC; the source prints only digits without their decade."""
    line = plots.film_against_temperature().axes[0].lines[0]
    assert np.interp(100.0, line.get_xdata(), line.get_ydata()) == pytest.approx(0.624, rel=2e-3)


@pytest.mark.parametrize(("celsius", "printed"), [(40.0, 14.8), (100.0, 10.4), (150.0, 8.11)])
def test_alpha_of_mobil_jet_ii_is_that_of_table_7(celsius, printed):
    line = plots.pressure_viscosity(["mobil_jet_ii"]).axes[0].lines[0]
    assert np.interp(celsius, line.get_xdata(), line.get_ydata()) == pytest.approx(printed, rel=0.02)


def test_unknown_parameter_is_named():
    with pytest.raises(ValueError, match="found 'modulus'"):
        plots.traction_against_rheology("modulus")
