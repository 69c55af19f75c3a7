"""pyvista and VTK: the .pvd, its times, and all arrays."""

import pyvista

from films import films, same

for name, film in films.items():
    reader = pyvista.get_reader(film.exports / "film.pvd")
    times = [float(frame["time"]) for frame in film.frames]
    same(reader.time_values, times, "times", 1e-12)
    for frame, time in enumerate(times, 1):
        reader.set_active_time_value(reader.time_values[frame - 1])
        grid = reader.read()[0]
        same(grid.points, film.positions(frame), f"{name}: points of frame {frame}")
        same(grid.cells_dict[pyvista.CellType.TRIANGLE], film.triangles, "faces")
        fields = film.fields(frame)
        for field in ("length_error", "energy_density", "bending_angle", "generators"):
            same(grid.cell_data[field], fields[field], field)
        for field in ("gaussian_curvature", "mean_curvature", "conformal_factor"):
            same(grid.point_data[field], fields[field], field)
        same(grid.point_data["normal"], fields["normals"], "normals")
        same(grid.point_data["pinned"], film.mesh["pinned"], "pins")
        same(grid.point_data["file_vertex"], film.mesh["file_vertex"], "numbers in the file")
        parts = grid.connectivity()["RegionId"].max() + 1
        assert grid.cell_data["component"].max() == parts, "components"
    print(f"vtk: {name}: {len(times)} times: as in the film")
