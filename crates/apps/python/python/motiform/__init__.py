"""motiform: a laboratory for deformable self-propelled domains.

>>> import motiform
>>> body = motiform.preset("fig5a")            # or motiform.Tensor(kappa2=0.5, ...), motiform.Cell(length=21.6)
>>> run = body.simulate(200.0)                 # run.t, run.position, run["s11"], run.to_pandas(), run.plot()
>>> body.classify().regime
>>> motiform.scan(motiform.preset("fig1"), {"kappa2": "-0.2:0.2:40", "gamma": "-0.1:0.1:40"})

All quantities are in model units of time and length, unless ``units`` are asked for (docs/units.md); parameters have the paper's names.
"""

from . import bodies, cells
from ._registry import MODELS, PRESETS, REGIMES, STEPPERS
from ._registry import VERSION as __version__
from .atlases import Atlas, Boundary, Region
from .bodies import *  # noqa: F403
from .branches import Branch, Branches
from .curves import Curve, Curves
from .ensembles import Ensemble, ensemble
from .equations import Amplitudes
from .errors import Doubtful, EndedEarly, Incomplete, Interrupted, WorkersLost
from .fields import Field, Orbit
from .lifetimes import Lifetimes
from .measurements import Measured, Statistics, statistics
from .models import Model, preset, study
from .reading import chunks, read
from .results import Accuracy, Crossings, Equilibrium, Estimate, Exponents, Motions, Outcome, Share, Spread, Verdict
from .scans import merge, scan
from .trajectory import Trajectory
from .units import Units
from .verification import Verification, verify

__all__ = [
    "MODELS",
    "PRESETS",
    "REGIMES",
    "STEPPERS",
    "Accuracy",
    "Amplitudes",
    "Atlas",
    "Boundary",
    "Branch",
    "Branches",
    "Crossings",
    "Curve",
    "Curves",
    "Doubtful",
    "EndedEarly",
    "Ensemble",
    "Equilibrium",
    "Estimate",
    "Exponents",
    "Field",
    "Incomplete",
    "Interrupted",
    "Lifetimes",
    "Measured",
    "Model",
    "Motions",
    "Orbit",
    "Outcome",
    "Region",
    "Share",
    "Spread",
    "Statistics",
    "Trajectory",
    "Units",
    "Verdict",
    "Verification",
    "WorkersLost",
    "__version__",
    "cells",
    "chunks",
    "ensemble",
    "merge",
    "preset",
    "read",
    "scan",
    "statistics",
    "study",
    "verify",
]
__all__ += bodies.__all__
