# SPDX-License-Identifier: MIT
"""Blender add-on: UV > Unwrap with Atlas. It needs the package atlas_uv in Blender's Python.

In edit mode it unwraps the selected faces of all objects that are edited, in object mode all faces of the selected meshes.
They share one atlas, with one density of texels as the objects lie in the world. Seams are cut. An island that has a pinned
vertex stays as it is and where it is, and the others are packed around it, and around all other faces if so wished.
"""

import threading

import bmesh
import bpy
import numpy as np
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty

try:
    import atlas_uv
except ImportError:
    atlas_uv = None

bl_info = {
    "name": "Unwrap with Atlas",
    "author": "Atlas contributors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "UV > Unwrap with Atlas",
    "description": "Unwraps and packs, proved free of flips and overlaps",
    "category": "UV",
}


class Part:
    """The faces of one object that are unwrapped, and those that they keep clear of, as arrays.

    The mesh is not touched before `write()`.
    """

    def __init__(self, obj, keeps_clear=False):
        self.mesh = obj.data
        with Editing(self.mesh) as bm:
            self.positions = np.array([v.co for v in bm.verts]).reshape(-1, 3)
            chosen = [f for f in bm.faces if f.select] if self.mesh.is_editmode else list(bm.faces)
            layer = bm.loops.layers.uv.active
            self.seams = [[v.index for v in e.verts] for e in bm.edges if e.seam]
            self.is_wanted = bool(chosen)
            kept = pinned_faces(chosen, layer) if layer else set()
            if keeps_clear and layer:
                kept |= {f.index for f in bm.faces} - {f.index for f in chosen}
                chosen = list(bm.faces)
            self.faces = [f.index for f in chosen]
            self.polygons = [[v.index for v in f.verts] for f in chosen]
            self.is_kept = np.array([f.index in kept for f in chosen], bool)
            self.uvs = [[tuple(loop[layer].uv) for loop in f.loops] if f.index in kept else None for f in chosen]
        self.pages = np.zeros(len(self.faces), np.uint32)
        world = np.array(obj.matrix_world)
        self.positions = self.positions @ world[:3, :3].T + world[:3, 3]
        if np.linalg.det(world[:3, :3]) < 0:  # fronts of faces are those of the mesh, not of its mirror image
            self.positions[:, 0] *= -1

    def add_to(self, atlas):
        """All faces; those that stay with their coordinates."""
        none = (np.nan, np.nan)
        corners = [uv for polygon, uvs in zip(self.polygons, self.uvs) for uv in uvs or [none] * len(polygon)]
        first = np.cumsum([0] + [len(polygon) for polygon in self.polygons])
        numbers = [list(range(a, b)) for a, b in zip(first, first[1:])]
        kept = {"uvs": np.array(corners).reshape(-1, 2), "uv_faces": numbers, "selected": ~self.is_kept}
        atlas.add_mesh(self.positions, self.polygons, seams=self.seams or None, **(kept if self.is_kept.any() else {}))

    def take(self, result):
        """Takes over new coordinates."""
        corners = result.corner_uvs.reshape(-1, 2)
        first = 0
        for face, page in enumerate(result.face_pages):
            end = first + len(self.polygons[face])
            self.uvs[face] = corners[first:end].tolist()
            self.pages[face] = page
            first = end

    def write(self):
        """Coordinates into the mesh; pages are UDIM tiles."""
        with Editing(self.mesh) as bm:
            layer = bm.loops.layers.uv.verify()
            bm.faces.ensure_lookup_table()
            for i in np.flatnonzero(~self.is_kept):
                column, row = int(self.pages[i]) % 10, int(self.pages[i]) // 10
                for loop, (u, v) in zip(bm.faces[self.faces[i]].loops, self.uvs[i]):
                    loop[layer].uv = u + column, v + row


class Editing:
    """A mesh as a BMesh, in edit mode and out of it."""

    def __init__(self, mesh):
        self.mesh = mesh

    def __enter__(self):
        if self.mesh.is_editmode:
            self.bm = bmesh.from_edit_mesh(self.mesh)
        else:
            self.bm = bmesh.new()
            self.bm.from_mesh(self.mesh)
        self.bm.verts.index_update()
        self.bm.faces.index_update()
        return self.bm

    def __exit__(self, *error):
        if self.mesh.is_editmode:
            bmesh.update_edit_mesh(self.mesh, loop_triangles=False, destructive=False)
            return
        if error[0] is None:
            self.bm.to_mesh(self.mesh)
        self.bm.free()


def pinned_faces(faces, layer):
    """The numbers of the faces whose island has a pinned vertex. Islands go on where both corners of an edge agree."""
    chosen = {f.index: f for f in faces}
    todo = [f for f in faces if any(loop[layer].pin_uv for loop in f.loops)]
    found = {f.index for f in todo}
    while todo:
        for loop in todo.pop().loops:
            for other in loop.edge.link_loops:
                face = other.face.index
                if face in chosen and face not in found and joins(loop, other, layer):
                    found.add(face)
                    todo.append(other.face)
    return found


def joins(a, b, layer):
    """Whether two faces at one edge are together on the page."""
    a, b = ({loop.vert.index: loop[layer].uv.to_tuple(6) for loop in (x, x.link_loop_next)} for x in (a, b))
    return a == b


def unwrap(parts, options, progress=None):
    """Gives all parts their coordinates. :returns: the report, empty if all faces stay"""
    if all(part.is_kept.all() for part in parts):
        return {}
    if any(part.is_kept.any() for part in parts) and options.get("stack", "none") != "none":
        raise ValueError("Charts cannot be stacked around islands that stay")
    atlas = atlas_uv.Atlas(**options)
    for part in parts:
        part.add_to(atlas)
    report = atlas.generate(progress)
    for i, part in enumerate(parts):
        part.take(atlas.result(i))
    return report


class UV_OT_unwrap_with_atlas(bpy.types.Operator):
    """Unwrap the selected faces into one atlas without flips and overlaps"""

    bl_idname = "uv.unwrap_with_atlas"
    bl_label = "Unwrap with Atlas"
    bl_options = {"REGISTER", "UNDO"}

    mode: EnumProperty(
        name="Mode", default="standard",
        items=[
            ("standard", "Standard", "Few charts with low distortion"),
            ("few-seams", "Few Seams", "Fewer and larger charts with more distortion"),
            ("conformal", "Conformal", "Least squares conformal maps as they are"),
        ],
    )
    hide_seams: EnumProperty(
        name="Hide Seams", default="none",
        items=[
            ("none", "No", "Seams keep to creases"),
            ("openness", "In Cavities", "Seams run where the model shades itself"),
            ("dome:z", "From Above", "Seams run where viewers above the ground do not see them (local Z)"),
        ],
    )
    symmetry: EnumProperty(
        name="Symmetry", default="off",
        items=[
            ("off", "Off", "Seams are looked for on their own"),
            ("auto", "Auto", "Seams are mirrored where the mesh is its own mirror image"),
            ("x", "X", "At a plane across the local X axis"),
            ("y", "Y", "At a plane across the local Y axis"),
            ("z", "Z", "At a plane across the local Z axis"),
        ],
    )
    keep_clear: BoolProperty(
        name="Around Other Faces", default=False,
        description="In edit mode: pack around the islands of faces that are not selected. They have to lie on the first tile",
    )
    use_seams: BoolProperty(name="Cut at Seams", default=True, description="Edges that are marked become seams")
    max_distortion: FloatProperty(
        name="Most Distortion", default=0, min=0, soft_max=3,
        description="Charts merge while their mean distortion stays below this, at least 1; 0: that of the mode",
    )
    max_charts: IntProperty(name="Most Charts", default=0, min=0, description="0: no limit")
    hard_angle: FloatProperty(
        name="Hard Angle", default=0, min=0, max=np.pi, subtype="ANGLE", description="Cut at edges sharper than this; 0: none"
    )
    straighten: BoolProperty(name="Straighten Grids", default=False, description="Grids of quads become rectangles")
    width: IntProperty(name="Width", default=1024, min=1, max=65536, description="Of the page, texels")
    height: IntProperty(name="Height", default=1024, min=1, max=65536, description="Of the page, texels")
    gutter: FloatProperty(name="Gutter", default=4, min=0, soft_max=64, description="Least distance of charts, texels")
    pages: IntProperty(name="Pages", default=1, min=1, max=100, description="UDIM tiles that may be filled")
    rotation: EnumProperty(
        name="Rotation", default="aligned",
        items=[
            ("aligned", "Aligned", "Charts with straight borders lie parallel to an axis"),
            ("free", "Free", "Charts turn as they like"),
            ("quarter", "Quarter Turns", "Charts turn by 90 degrees"),
            ("none", "None", "Charts do not turn"),
        ],
    )
    stack: EnumProperty(
        name="Stack", default="none",
        items=[
            ("none", "None", "Every chart has a place of its own"),
            ("copies", "Copies", "Charts that are equal share a place"),
            ("mirrored", "Copies and Mirrored", "Mirror images share a place too"),
        ],
    )
    effort: EnumProperty(
        name="Effort", default="fast", items=[(word, word.capitalize(), "") for word in ("fast", "normal", "best")]
    )
    snap: BoolProperty(name="Snap to Texels", default=False, description="Straight borders lie on borders of texels")

    @classmethod
    def poll(cls, context):
        return context.mode in {"EDIT_MESH", "OBJECT"} and any(o.type == "MESH" for o in context.selected_objects)

    def wishes(self):
        """As atlas_uv calls them."""
        return {
            "mode": self.mode, "symmetry": self.symmetry, "max_distortion": self.max_distortion, "max_charts": self.max_charts,
            "hard_angle": float(np.degrees(self.hard_angle)), "straighten": self.straighten,
            "texture_size": (self.width, self.height), "gutter": self.gutter, "pages": self.pages, "rotation": self.rotation,
            "stack": self.stack, "effort": self.effort, "snap": self.snap,
            "hide_seams": None if self.hide_seams == "none" else self.hide_seams,
        }

    def collect(self, context):
        """What is to be unwrapped, or None with a report on why there is nothing."""
        if atlas_uv is None:
            self.report({"ERROR"}, "The package atlas_uv is not installed in Blender's Python")
            return None
        if context.mode == "EDIT_MESH":
            objects = context.objects_in_mode_unique_data
        else:
            objects = {o.data: o for o in context.selected_objects if o.type == "MESH"}.values()
        parts = [part for part in (Part(obj, self.keep_clear) for obj in objects) if part.faces]
        if not any(part.is_wanted for part in parts):
            self.report({"ERROR"}, "No faces are selected")
            return None
        if not self.use_seams:
            for part in parts:
                part.seams = []
        return parts

    def finish(self, parts, report):
        """Writes the coordinates, and tells about them."""
        for part in parts:
            part.write()
        if not report:
            self.report({"INFO"}, "All islands are pinned: nothing has changed")
        elif report["is_valid"]:
            count, share = report["number_of_charts"], 100 * report["packing_efficiency"]
            self.report({"INFO"}, f"{count} chart{'s' * (count != 1)}, {share:.0f} % of the page")
        else:
            self.report({"WARNING"}, report["certificate"]["message"])
        return {"FINISHED"}

    def fail(self, error):
        if isinstance(error, atlas_uv.Cancelled):
            self.report({"INFO"}, "Cancelled")
        elif isinstance(error, (RuntimeError, ValueError)):
            self.report({"ERROR"}, str(error))
        else:
            raise error
        return {"CANCELLED"}

    def execute(self, context):
        parts = self.collect(context)
        if parts is None:
            return {"CANCELLED"}
        try:
            report = unwrap(parts, self.wishes())
        except Exception as error:  # `fail()` raises what it does not know
            return self.fail(error)
        return self.finish(parts, report)

    def invoke(self, context, event):
        self.parts = self.collect(context)
        if self.parts is None:
            return {"CANCELLED"}
        self.job = Job(self.parts, self.wishes())
        self.timer = context.window_manager.event_timer_add(0.1, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        """Until the work is done all events end here: the mesh must stay as it is."""
        if event.type == "ESC":
            self.job.is_cancelled = True
        if event.type != "TIMER":
            return {"RUNNING_MODAL"}
        stage, fraction = self.job.news
        context.workspace.status_text_set(f"Atlas: {stage} {100 * fraction:.0f} %    Esc: cancel")
        if self.job.thread.is_alive():
            return {"RUNNING_MODAL"}
        context.workspace.status_text_set(None)
        context.window_manager.event_timer_remove(self.timer)
        if self.job.error is not None:
            return self.fail(self.job.error)
        return self.finish(self.parts, self.job.report)


class Job:
    """Unwraps in a thread of its own, on arrays alone: Blender's data belong to the main thread."""

    def __init__(self, parts, options):
        self.news = "segmentation", 0.0
        self.is_cancelled = False
        self.error = self.report = None
        self.thread = threading.Thread(target=self.run, args=(parts, options), daemon=True)
        self.thread.start()

    def run(self, parts, options):
        try:
            self.report = unwrap(parts, options, self.hear)
        except Exception as error:
            self.error = error

    def hear(self, stage, fraction):
        self.news = stage, fraction
        return not self.is_cancelled


def draw_menu(menu, context):
    menu.layout.separator()
    menu.layout.operator(UV_OT_unwrap_with_atlas.bl_idname)


MENUS = ("VIEW3D_MT_uv_map", "IMAGE_MT_uvs")


def register():
    bpy.utils.register_class(UV_OT_unwrap_with_atlas)
    for menu in MENUS:
        getattr(bpy.types, menu).append(draw_menu)


def unregister():
    for menu in MENUS:
        getattr(bpy.types, menu).remove(draw_menu)
    bpy.utils.unregister_class(UV_OT_unwrap_with_atlas)
