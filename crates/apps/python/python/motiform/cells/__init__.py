"""Tracked cells: outlines in, and out come modes of the shape, the observed motion, and a fitted model.

>>> cells = motiform.cells.read("track.xml")              # or from_arrays({...}), read_masks("01_RES")
>>> cell = cells[0]
>>> cell.modes, cell.flags, cell.notes
>>> cell.observe().regime, cell.observe().plot()          # 'undecided' with the reason, where the record is not enough
>>> fit = cell.fit()
>>> fit.regime, fit.why, fit.coefficients, fit.plot()
>>> cell.place()                                          # on the plane of Fig. 4, or why there is no place
>>> fit.model.classify(), fit.noisy_model.simulate(500.0) # the fit is a model like all others

Formats, definitions and limits: docs/cells.md and docs/inference.md.
"""

from .reading import Outlines, from_arrays, read, read_masks
from .results import CellFit, Found, Noise, Observation, Place, Value
from .sample import Cell, Cells

__all__ = [
    "Cell",
    "CellFit",
    "Cells",
    "Found",
    "Noise",
    "Observation",
    "Outlines",
    "Place",
    "Value",
    "from_arrays",
    "read",
    "read_masks",
]
