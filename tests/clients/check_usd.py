"""usd-core: points, normals, primvars, curves, camera, lights and metadata of the stage; all its validators."""

import numpy
from pxr import Usd, UsdGeom, UsdLux, UsdShade, UsdValidation

from films import films, same, single

for name, film in films.items():
    path = str(film.exports / "film.usda")
    stage = Usd.Stage.Open(path)
    assert stage, "the stage opens"
    last = len(film)
    assert (stage.GetStartTimeCode(), stage.GetEndTimeCode()) == (1, last)
    rate = 12 if name == "closed" else 24
    assert stage.GetFramesPerSecond() == stage.GetTimeCodesPerSecond() == rate
    assert UsdGeom.GetStageUpAxis(stage) in ("Y", "Z") and UsdGeom.GetStageMetersPerUnit(stage) == 1
    root = stage.GetDefaultPrim()
    assert root and root.GetName() == name

    mesh = UsdGeom.Mesh(root.GetChild("surface"))
    assert mesh.GetSubdivisionSchemeAttr().Get() == "none" and mesh.GetDoubleSidedAttr().Get()
    same(numpy.reshape(mesh.GetFaceVertexIndicesAttr().Get(), (-1, 3)), film.triangles, "faces")
    assert mesh.GetPointsAttr().GetTimeSamples() == list(range(1, last + 1))
    primvars = UsdGeom.PrimvarsAPI(mesh)
    for frame in (1, last):
        same(mesh.GetPointsAttr().Get(frame), single(film.positions(frame)), f"{name}: points of frame {frame}")
        fields = film.fields(frame)
        same(mesh.GetNormalsAttr().Get(frame), fields["normals"], "normals")
        low, high = mesh.GetExtentAttr().Get(frame)
        same(low, single(film.positions(frame).min(axis=0)), "extent")
        same(high, single(film.positions(frame).max(axis=0)), "extent")
        for field in ("length_error", "gaussian_curvature", "mean_curvature", "conformal_factor", "energy_density",
                      "bending_angle", "generators"):
            primvar = primvars.GetPrimvar(field)
            same(primvar.Get(frame), fields[field], f"{name}: {field}")
            counts = {"uniform": len(film.triangles), "vertex": len(film.positions(1))}
            assert counts[primvar.GetInterpolation()] == len(fields[field]), field
        same(primvars.GetPrimvar("length_error").Get(frame), film.length_error(frame), "length error", 1e-6)
    # Between two frames points are interpolated.
    middle = 0.5 * (film.positions(1) + film.positions(2))
    same(mesh.GetPointsAttr().Get(1.5), middle, "between frames", 1e-6)

    colors = primvars.GetPrimvar("displayColor")
    count = len(colors.Get(1))
    assert count == (len(film.positions(1)) if name == "closed" else 1), count
    components = UsdGeom.Subset.GetGeomSubsets(mesh, "face", "component")
    assert len(components) == (2 if name == "parts" else 0)
    if components:
        faces = sorted(i for part in components for i in part.GetIndicesAttr().Get())
        assert faces == list(range(len(film.triangles)))
        valid, why = UsdGeom.Subset.ValidateFamily(mesh, "face", "component")
        assert valid, why

    rims = UsdGeom.BasisCurves(root.GetChild("rims"))
    for frame in range(1, last + 1):
        marked = int(film.frames[frame - 1]["rims"].sum())
        assert list(rims.GetCurveVertexCountsAttr().Get(frame)) == [2] * marked
        crossings = UsdGeom.BasisCurves(root.GetChild("self_intersections"))
        assert len(crossings.GetPointsAttr().Get(frame)) == 2 * len(crossings.GetCurveVertexCountsAttr().Get(frame))
    boundary, pins = root.GetChild("boundary"), root.GetChild("pins")
    assert bool(boundary) == bool(pins) == (name == "parts")
    if boundary:
        curves = UsdGeom.BasisCurves(boundary)
        assert list(curves.GetCurveVertexCountsAttr().Get()) == [4] and curves.GetWrapAttr().Get() == "periodic"
        held = numpy.flatnonzero(film.mesh["pinned"])
        same(UsdGeom.Points(pins).GetPointsAttr().Get(last), single(film.positions(last)[held]), "pins")

    camera = UsdGeom.Camera(root.GetChild("camera")).GetCamera(1)
    perspective = camera.projection == camera.Perspective
    assert perspective == (name == "closed")
    if perspective:
        assert abs(camera.GetFieldOfView(camera.FOVVertical) - 35) < 1e-3
    assert abs(camera.aspectRatio - 320 / 240) < 1e-5
    # All vertices are in the picture.
    for frame in (1, last):
        frustum = UsdGeom.Camera(root.GetChild("camera")).GetCamera(frame).frustum
        project = frustum.ComputeViewMatrix() * frustum.ComputeProjectionMatrix()
        for point in film.positions(frame):
            x, y, _ = project.Transform(tuple(point))
            assert abs(x) < 1 and abs(y) < 1, f"{name}: vertex out of sight at {x}, {y}"
    lights = [prim for prim in stage.Traverse() if prim.HasAPI(UsdLux.LightAPI)]
    assert len(lights) >= 2
    material, _ = UsdShade.MaterialBindingAPI(mesh.GetPrim()).ComputeBoundMaterial()
    assert material.ComputeSurfaceSource()[0]

    errors = UsdValidation.ValidationContext(UsdValidation.ValidationRegistry().GetOrLoadAllValidators()).Validate(stage)
    assert not errors, [error.GetMessage() for error in errors]
    print(f"usd: {name}: {last} frames, {len(film.positions(1))} points: as in the film")
