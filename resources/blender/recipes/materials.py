# SPDX-License-Identifier: GPL-2.0-or-later OR BSD-3-Clause
"""Procedural materials: nothing is read from files. Patterns lie in the coordinates of the object,
so `size` is in scene units."""

import bpy


class _Nodes:
    """Builds the node tree of a new material."""

    def __init__(self, name):
        self.material = bpy.data.materials.new(name)
        self.material.use_nodes = True
        self.tree = self.material.node_tree
        self.shader = self.tree.nodes["Principled BSDF"]
        self.output = self.tree.nodes["Material Output"]

    def add(self, kind, **values):
        node = self.tree.nodes.new("ShaderNode" + kind)
        for name, value in values.items():
            setattr(node, name, value)
        return node

    def link(self, source, target):
        self.tree.links.new(source, target)

    def set(self, node, **values):
        """Inputs by their names, with _ for a blank."""
        for name, value in values.items():
            node.inputs[name.replace("_", " ")].default_value = value

    def finish(self, roughness, specular=0.3):
        self.set(self.shader, Roughness=roughness)
        for name in ("Specular", "Specular IOR Level"):  # before and from Blender 4.0
            if name in self.shader.inputs:
                self.shader.inputs[name].default_value = specular
        return self.material

    def coordinates(self, stretch=(1, 1, 1)):
        place = self.add("TexCoord")
        scale = self.add("Mapping")
        self.link(place.outputs["Object"], scale.inputs["Vector"])
        self.set(scale, Scale=stretch)
        return scale.outputs["Vector"]

    def noise(self, vector, size, detail=3.0, distortion=0.0):
        node = self.add("TexNoise")
        self.set(node, Scale=1 / size, Detail=detail, Distortion=distortion)
        self.link(vector, node.inputs["Vector"])
        return node.outputs["Fac"]

    def ramp(self, value, stops):
        """`stops`: (position, color) pairs."""
        node = self.add("ValToRGB")
        elements = node.color_ramp.elements
        while len(elements) < len(stops):
            elements.new(0.5)
        for element, (position, color) in zip(elements, stops):
            element.position = position
            element.color = (*color, 1)
        self.link(value, node.inputs["Fac"])
        return node.outputs["Color"]

    def color(self, socket):
        self.link(socket, self.shader.inputs["Base Color"])


def _scaled(color, factor):
    return tuple(min(1.0, channel * factor) for channel in color)


def plain(name, color, roughness=0.6):
    nodes = _Nodes(name)
    nodes.set(nodes.shader, Base_Color=(*color, 1))
    return nodes.finish(roughness)


def mottled(name, color, size=0.15, contrast=0.5, roughness=0.7):
    """Clouds of lighter and darker tones: plaster, clay, stone, fruit."""
    nodes = _Nodes(name)
    value = nodes.noise(nodes.coordinates(), size, detail=4)
    dark, light = _scaled(color, 1 - contrast), _scaled(color, 1 + contrast)
    nodes.color(nodes.ramp(value, [(0.3, dark), (0.7, light)]))
    return nodes.finish(roughness)


def wood(name, color, size=0.12, roughness=0.45):
    """Rings that are drawn out along x."""
    nodes = _Nodes(name)
    value = nodes.noise(nodes.coordinates((0.12, 1, 1)), size, detail=5, distortion=1.2)
    stops = [
        (0.25, _scaled(color, 0.45)),
        (0.5, color),
        (0.62, _scaled(color, 0.7)),
        (0.8, _scaled(color, 1.25)),
    ]
    nodes.color(nodes.ramp(value, stops))
    return nodes.finish(roughness)


def checks(name, first, second, size=0.25, roughness=0.8):
    """A chequered cloth with some unevenness."""
    nodes = _Nodes(name)
    vector = nodes.coordinates()
    pattern = nodes.add("TexChecker")
    nodes.set(pattern, Scale=1 / size, Color1=(*first, 1), Color2=(*second, 1))
    nodes.link(vector, pattern.inputs["Vector"])
    shade = nodes.ramp(nodes.noise(vector, size / 3), [(0.3, (0.6,) * 3), (0.7, (1.0,) * 3)])
    mix = nodes.add("MixRGB", blend_type="MULTIPLY")
    nodes.set(mix, Fac=0.6)
    nodes.link(pattern.outputs["Color"], mix.inputs["Color1"])
    nodes.link(shade, mix.inputs["Color2"])
    nodes.color(mix.outputs["Color"])
    return nodes.finish(roughness)


def stripes(name, colors, size=0.2, direction="Z", roughness=0.6):
    """Bands across an axis, slightly wavy."""
    nodes = _Nodes(name)
    wave = nodes.add("TexWave", wave_type="BANDS", bands_direction=direction)
    nodes.set(wave, Scale=0.314 / size, Distortion=0.6, Detail=1.0)
    nodes.link(nodes.coordinates(), wave.inputs["Vector"])
    last = len(colors) - 1
    stops = [(i / max(1, last) * 0.8 + 0.1, color) for i, color in enumerate(colors)]
    nodes.color(nodes.ramp(wave.outputs["Fac"], stops))
    return nodes.finish(roughness)


def speckled(name, color, speck, size=0.06, roughness=0.35):
    """Glaze with spots."""
    nodes = _Nodes(name)
    cells = nodes.add("TexVoronoi")
    nodes.set(cells, Scale=1 / size)
    nodes.link(nodes.coordinates(), cells.inputs["Vector"])
    nodes.color(nodes.ramp(cells.outputs["Distance"], [(0.22, speck), (0.34, color)]))
    return nodes.finish(roughness)


def pane(name, color, opacity=0.4, size=0.5):
    """Glass that light passes straight through, with a print by which its own place can be seen."""
    nodes = _Nodes(name)
    value = nodes.noise(nodes.coordinates(), size, detail=4)
    nodes.color(nodes.ramp(value, [(0.35, _scaled(color, 0.25)), (0.65, color)]))
    clear = nodes.add("BsdfTransparent")
    mix = nodes.add("MixShader")
    nodes.set(mix, Fac=opacity)
    nodes.link(clear.outputs["BSDF"], mix.inputs[1])
    nodes.link(nodes.shader.outputs["BSDF"], mix.inputs[2])
    nodes.link(mix.outputs["Shader"], nodes.output.inputs["Surface"])
    return nodes.finish(0.6)
