"""State script for ParaView 5.11 or later: von Mises stress of a crush on its deformed section, at the peak.

    pvpython scripts/paraview-peak.py out/single-asperity --to peak.png
    paraview --script=scripts/paraview-peak.py        # then it asks ASPERITY_RESULTS for the folder

Crush with fields first, for example: asperity crush meshes/single-asperity.toml. A body of revolution is mirrored.
"""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from paraview_section import even_edges, main

main("von_mises_MPa", "von Mises stress (MPa)", even_edges)
