"""The package `fitting` by the name of this one: `jaxbearing.fitting` and `fitting` are the same module."""

import sys

import fitting

sys.modules[__name__] = fitting
