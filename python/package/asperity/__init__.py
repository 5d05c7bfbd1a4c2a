"""Crushes rough metal on the computer, from one conical asperity to a whole measured surface.

>>> import asperity
>>> scene = asperity.Scene(
...     symmetry="axisymmetric", accuracy="draft",
...     material={"youngs_modulus": "210 GPa", "poissons_ratio": 0.3, "yield_stress": "300 MPa", "hardening_exponent": 0.3},
...     asperity=[{"height": "20 um", "slope_deg": 10, "tip_radius": "10 um"}],
...     tool={"shape": "plane"}, loading={"depth": "1 um"}, output={"every": 0},
... )
>>> result = asperity.crush(scene)
>>> bool(result.curve["force_N"][-1] == result.summary["peak_force_N"])
True

Every function computes in a thread of its own without the interpreter's lock, ends at Ctrl-C, and takes ``progress``, a
function of the share that is done (0 to 1) and a text.  What is wrong with a scene is an :class:`InputError` that names its key.
Doubts about a result are in its ``warnings``, and are told by Python's own as well.
"""

from . import keys
from ._asperity import (
    InputError,
    RoughScene,
    Scene,
    UnfinishedError,
    __version__,
)
from ._functions import calibrate, crush, extract, identify, joint, press, scales, study, trade
from ._results import (
    Calibration,
    Crush,
    Extraction,
    Fields,
    Identification,
    Joint,
    Rough,
    Scales,
    Study,
    Table,
    Trade,
)

__all__ = [
    "Calibration",
    "Crush",
    "Extraction",
    "Fields",
    "Identification",
    "InputError",
    "Joint",
    "Rough",
    "RoughScene",
    "Scales",
    "Scene",
    "Study",
    "Table",
    "Trade",
    "UnfinishedError",
    "__version__",
    "calibrate",
    "crush",
    "extract",
    "identify",
    "joint",
    "keys",
    "press",
    "scales",
    "study",
    "trade",
]
