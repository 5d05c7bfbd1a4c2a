"""State script for ParaView 5.11 or later: accumulated plastic strain of a crush on its deformed section, at the peak.

    pvpython scripts/paraview-plastic.py out/single-asperity --to plastic.png

Crush with fields first, for example: asperity crush meshes/single-asperity.toml. A body of revolution is mirrored.
"""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from paraview_section import main, strain_edges

main("plastic_strain", "accumulated plastic strain; pale: elastic", strain_edges, pale=True)
