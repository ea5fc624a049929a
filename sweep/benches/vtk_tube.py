"""The trefoil tube of 4000 x 250 cells by VTK's TubeFilter and by sweep, in turn.

Needs VTK and numpy from PyPI and a release build of sweep:

    python3 sweep/benches/vtk_tube.py target/release/sweep

VTK gets the points of the trajectory and makes points, ring normals and strips, with the seam left
open. sweep finds frames, points and exact normals and closes the seam; its time is the stage that
`--stats` calls sweep, on one thread. Both start with new memory. Prints pairs and their ratios.
"""

import pathlib
import re
import statistics
import subprocess
import sys
import time

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk

ROWS, COLS, PAIRS = 4000, 250, 15
SPEC = pathlib.Path(__file__).parents[2] / "examples/curves/trefoil.json"


def trefoil(t):
    return np.stack([np.sin(t) + 2 * np.sin(2 * t), np.cos(t) - 2 * np.cos(2 * t), -np.sin(3 * t)], -1)


def by_vtk(line):
    start = time.perf_counter()
    points = vtk.vtkPoints()
    points.SetData(numpy_to_vtk(line, deep=1))
    cells = vtk.vtkCellArray()
    cells.InsertNextCell(len(line))
    for i in range(len(line)):
        cells.InsertCellPoint(i)
    curve = vtk.vtkPolyData()
    curve.SetPoints(points)
    curve.SetLines(cells)
    tube = vtk.vtkTubeFilter()
    tube.SetInputData(curve)
    tube.SetRadius(0.45)
    tube.SetNumberOfSides(COLS)
    tube.SetOutputPointsPrecision(vtk.vtkAlgorithm.DOUBLE_PRECISION)
    tube.Update()
    assert tube.GetOutput().GetNumberOfPoints() >= ROWS * COLS
    return time.perf_counter() - start


def by_sweep(program):
    size = ["--rows", str(ROWS), "--cols", str(COLS), "--threads", "1"]
    words = subprocess.run(
        [program, SPEC, *size, "-q", "--stats", "-o", "/dev/null"],
        check=True, capture_output=True, text=True,
    ).stderr
    stage = lambda name: float(re.search(rf"^{name} +([0-9.]+) ms", words, re.M)[1]) / 1e3
    return stage("sweep"), stage("write")


def main():
    line = trefoil(np.linspace(0, 2 * np.pi, ROWS + 1))
    by_vtk(line), by_sweep(sys.argv[1])
    pairs = [(by_vtk(line), *by_sweep(sys.argv[1])) for _ in range(PAIRS)]
    for peer, swept, written in pairs:
        print(f"VTK {peer:.4f} s   sweep {swept:.4f} s   grid file {written:.4f} s   ratio {swept / peer:.2f}")
    ratios = sorted(swept / peer for peer, swept, _ in pairs)
    print(f"VTK {vtk.vtkVersion.GetVTKVersion()}: median ratio {statistics.median(ratios):.2f}"
          f" ({ratios[0]:.2f} to {ratios[-1]:.2f}) in {PAIRS} pairs")


main()
