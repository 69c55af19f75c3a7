"""A film in Blender: an animated object with its colours, seen through the film's camera in its light.

    immerse export renders/hare --format usd
    blender --python docs/blender.py -- renders/hare/export/film.usda

From Python with the package bpy: `import blender; blender.film("renders/hare/export/film.usda")`.
"""

import sys

import bpy


def film(path):
    """Imports a stage that was exported and makes it ready to play and to render; returns the surface."""
    scene = bpy.context.scene
    before = set(bpy.data.objects)
    bpy.ops.wm.usd_import(filepath=str(path), import_subdivision=False, set_frame_range=True)
    new = [thing for thing in bpy.data.objects if thing not in before]
    surface = next(thing for thing in new if thing.type == "MESH" and "length_error" in thing.data.attributes)
    surface.data.shade_smooth()
    surface.data.materials.clear()
    surface.data.materials.append(clay("backColor" if "backColor" in surface.data.attributes else "displayColor"))
    for thing in new:
        if thing.type == "CAMERA":
            scene.camera = thing
            # Pictures have the shape of those of the film. What the camera sees is known at a frame only.
            scene.frame_set(scene.frame_start)
            scene.render.resolution_y = 1080
            scene.render.resolution_x = 2 * round(540 * thing.data.sensor_width / thing.data.sensor_height)
        elif thing.type == "LIGHT":
            # Blender takes a distant light of USD four times as strong.
            thing.data.energy /= 4
        elif thing.type in ("CURVES", "CURVE"):
            # Rims, self-intersections and the boundary have colours of their own.
            thing.data.materials.append(ink(thing.name))
    scene.world = scene.world or sky()
    scene.view_settings.view_transform = "Standard"
    return surface


def sky():
    """A warm white all around, as behind the pictures of a film."""
    world = bpy.data.worlds.new("sky")
    world.use_nodes = True
    nodes, links = world.node_tree.nodes, world.node_tree.links
    seen, light = nodes["Background"], nodes.new("ShaderNodeBackground")
    seen.inputs["Color"].default_value = (0.905, 0.896, 0.863, 1)
    light.inputs["Color"].default_value = (0.3, 0.3, 0.31, 1)
    # What is seen is brighter than what it gives.
    rays, mix = nodes.new("ShaderNodeLightPath"), nodes.new("ShaderNodeMixShader")
    links.new(rays.outputs["Is Camera Ray"], mix.inputs["Fac"])
    links.new(light.outputs["Background"], mix.inputs[1])
    links.new(seen.outputs["Background"], mix.inputs[2])
    links.new(mix.outputs["Shader"], nodes["World Output"].inputs["Surface"])
    return world


def clay(back):
    """A material that shows the colours of the film, and those named here on the back."""
    material = bpy.data.materials.new("film")
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    surface, side = nodes["Principled BSDF"], nodes.new("ShaderNodeNewGeometry")
    surface.inputs["Roughness"].default_value, surface.inputs["Specular IOR Level"].default_value = 0.4, 0.35
    mix = nodes.new("ShaderNodeMixRGB")
    for name, socket in (("displayColor", "Color1"), (back, "Color2")):
        color = nodes.new("ShaderNodeAttribute")
        color.attribute_name = name
        links.new(color.outputs["Color"], mix.inputs[socket])
    links.new(side.outputs["Backfacing"], mix.inputs["Fac"])
    links.new(mix.outputs["Color"], surface.inputs["Base Color"])
    return material


def ink(name):
    """A dark material, red for rims."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    inputs = material.node_tree.nodes["Principled BSDF"].inputs
    inputs["Base Color"].default_value = (0.6, 0.02, 0.02, 1) if name.startswith("rims") else (0.02, 0.02, 0.02, 1)
    inputs["Roughness"].default_value, inputs["Specular IOR Level"].default_value = 1, 0
    return material


if __name__ == "__main__" and "--" in sys.argv:
    for name in ("Cube", "Camera", "Light"):
        if name in bpy.data.objects:
            bpy.data.objects.remove(bpy.data.objects[name])
    film(sys.argv[sys.argv.index("--") + 1])
