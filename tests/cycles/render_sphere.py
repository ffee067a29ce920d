"""A white GGX sphere under a panorama, rendered by Blender's Cycles as Patina's default camera sees it.

    blender -b --factory-startup -P tests/cycles/render_sphere.py -- PANORAMA DISTRIBUTION ROUGHNESS SIZE SAMPLES OUT.exr

DISTRIBUTION: GGX bounces once between microfacets, has no Fresnel term and (up to 3.x) the separable Smith shadowing
G1(V) G1(L); MULTI_GGX bounces until the light has left (Heitz 2016) and loses none. Texels are constant (closest), the pixel filter is a box one pixel wide, nothing is
clamped: as in Patina's reference.
"""

import math
import sys

import bpy

panorama, distribution, roughness, size, samples, out = sys.argv[sys.argv.index("--") + 1:]

bpy.ops.object.select_all(action="SELECT")
bpy.ops.object.delete()

# Patina's (x, y, z) is Blender's (-z, -x, y): the panorama's middle then lies at -Z here and +X there.
bpy.ops.mesh.primitive_uv_sphere_add(segments=256, ring_count=128, radius=1.0)
bpy.ops.object.shade_smooth()
material = bpy.data.materials.new("ggx")
material.use_nodes = True
nodes, links = material.node_tree.nodes, material.node_tree.links
nodes.clear()
glossy = nodes.new("ShaderNodeBsdfGlossy")
glossy.distribution = distribution
glossy.inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
glossy.inputs["Roughness"].default_value = float(roughness)  # alpha is its square
links.new(glossy.outputs[0], nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
bpy.context.object.data.materials.append(material)

camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
bpy.context.collection.objects.link(camera)
camera.data.sensor_fit = "VERTICAL"
camera.data.angle = math.radians(30.0)
camera.location = (-4.5, 0.0, 0.0)
camera.rotation_euler = (-camera.location).to_track_quat("-Z", "Y").to_euler()

scene = bpy.context.scene
scene.camera = camera
world = bpy.data.worlds.new("world")
scene.world = world
world.use_nodes = True
texture = world.node_tree.nodes.new("ShaderNodeTexEnvironment")
texture.image = bpy.data.images.load(panorama)
texture.interpolation = "Closest"
world.node_tree.links.new(texture.outputs[0], world.node_tree.nodes["Background"].inputs["Color"])
world.cycles.sampling_method = "MANUAL"
world.cycles.sample_map_resolution = 2048

scene.render.engine = "CYCLES"
scene.cycles.samples = int(samples)
scene.cycles.use_adaptive_sampling = False
scene.cycles.use_denoising = False
scene.cycles.sample_clamp_direct = scene.cycles.sample_clamp_indirect = 0.0
scene.cycles.pixel_filter_type = "BOX"
scene.cycles.filter_width = 1.0
scene.cycles.blur_glossy = 0.0
scene.render.film_transparent = True
scene.render.resolution_x = scene.render.resolution_y = int(size)
scene.render.resolution_percentage = 100
scene.render.image_settings.file_format = "OPEN_EXR"
scene.render.image_settings.color_mode = "RGB"
scene.render.image_settings.color_depth = "32"
scene.render.filepath = out
bpy.ops.render.render(write_still=True)
