"""Opens a quarter annulus written by asperity with VTK itself and prints the radius error.

By hand:  ASPERITY_VTU_OUT=/tmp/annulus.vtu cargo test --test vtu quarter
          python tests/vtu_exact.py /tmp/annulus.vtu        (needs: pip install vtk)

VTK 9.7.2: 6 cells, worst radius error 6.7e-16 over 121 points each; area of the tessellation within 6.9e-5 (level 5).
"""

import math
import sys

import vtk

reader = vtk.vtkXMLUnstructuredGridReader()
reader.SetFileName(sys.argv[1])
reader.Update()
grid = reader.GetOutput()
breaks = [0.0, 0.4, 1.0]  # radial breaks of the patch in tests/vtu.rs; three elements along the angle
worst = 0.0
for index in range(grid.GetNumberOfCells()):
    cell = grid.GetCell(index)
    assert cell.GetCellType() == 77, cell.GetCellType()
    row = index // 3
    for k in range(121):
        r, s = (k % 11) / 10.0, (k // 11) / 10.0
        x, weights, sub = [0.0] * 3, [0.0] * cell.GetNumberOfPoints(), vtk.reference(0)
        cell.EvaluateLocation(sub, [r, s, 0.0], x, weights)
        exact = 1.0 + breaks[row] + s * (breaks[row + 1] - breaks[row])
        worst = max(worst, abs(math.hypot(x[0], x[1]) - exact))
print(f"VTK {vtk.vtkVersion().GetVTKVersion()}: {grid.GetNumberOfCells()} cells, radius error {worst:.1e}")

surface = vtk.vtkDataSetSurfaceFilter()
surface.SetInputData(grid)
surface.SetNonlinearSubdivisionLevel(5)
mass = vtk.vtkMassProperties()
triangles = vtk.vtkTriangleFilter()
triangles.SetInputConnection(surface.GetOutputPort())
mass.SetInputConnection(triangles.GetOutputPort())
mass.Update()
print(f"area of the tessellation / exact - 1 = {mass.GetSurfaceArea() / (0.75 * math.pi) - 1:.1e}")
ranges = {grid.GetPointData().GetArrayName(i) for i in range(grid.GetPointData().GetNumberOfArrays())}
print("point fields:", ", ".join(sorted(ranges)))
assert worst < 1e-14, worst
