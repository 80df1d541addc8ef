"""Functions of the C library.

Generated from include/muslin.h. To write it again: MUSLIN_BLESS=1 cargo xtask python
"""

from ctypes import CDLL, CFUNCTYPE, POINTER, c_char_p, c_float, c_size_t, c_uint32, c_void_p
from typing import Any, Callable, Final

from .structs import (
    MuslinAttachment, MuslinChanges, MuslinCloth, MuslinCollider, MuslinColliderDesc, MuslinEvent,
    MuslinGrab, MuslinGridDesc, MuslinHit, MuslinMaterial, MuslinMeshDesc, MuslinMeshReport,
    MuslinQuat, MuslinSettings, MuslinSewDesc, MuslinSkin, MuslinSkinDesc, MuslinStats,
    MuslinStream, MuslinVec3, MuslinView, MuslinWind, MuslinWriteDesc,
)

MuslinLogFn = CFUNCTYPE(None, c_uint32, c_char_p, c_void_p)

# Name, type of the result (None: a status), types of the parameters. Pointers to
# numbers are c_void_p, which takes addresses and byref().
_SIGNATURES: Final[list[tuple[str, Any, list[Any]]]] = [
    ("muslin_version", c_uint32, []),
    ("muslin_version_string", c_char_p, []),
    ("muslin_status_string", c_char_p, [c_uint32]),
    ("muslin_last_error", c_char_p, []),
    ("muslin_stage_name", c_char_p, [c_uint32]),
    ("muslin_set_log", None, [MuslinLogFn, c_uint32, c_void_p]),
    ("muslin_cloth_create_grid", None, [POINTER(MuslinGridDesc), POINTER(MuslinCloth)]),
    ("muslin_cloth_create_mesh", None, [POINTER(MuslinMeshDesc), POINTER(MuslinCloth)]),
    ("muslin_cloth_duplicate", None, [MuslinCloth, POINTER(MuslinCloth)]),
    ("muslin_cloth_destroy", None, [MuslinCloth]),
    ("muslin_cloth_reset", None, [MuslinCloth]),
    ("muslin_material_preset", None, [POINTER(MuslinMaterial), c_uint32]),
    ("muslin_cloth_get_settings", None, [MuslinCloth, POINTER(MuslinSettings)]),
    ("muslin_cloth_set_settings", None, [MuslinCloth, POINTER(MuslinSettings)]),
    ("muslin_cloth_get_material", None, [MuslinCloth, POINTER(MuslinMaterial)]),
    ("muslin_cloth_set_material", None, [MuslinCloth, POINTER(MuslinMaterial)]),
    ("muslin_cloth_set_wind", None, [MuslinCloth, POINTER(MuslinWind)]),
    ("muslin_cloth_advance", None, [MuslinCloth, c_float, c_void_p]),
    ("muslin_cloths_advance", None, [POINTER(MuslinCloth), c_uint32, c_float, c_void_p]),
    ("muslin_cloth_step", None, [MuslinCloth, c_uint32]),
    ("muslin_cloth_get_blend", None, [MuslinCloth, c_void_p]),
    ("muslin_cloth_is_asleep", None, [MuslinCloth, c_void_p]),
    ("muslin_cloth_get_wind", None, [MuslinCloth, POINTER(MuslinWind)]),
    ("muslin_cloth_get_time", None, [MuslinCloth, c_void_p, c_void_p]),
    ("muslin_cloth_get_mass", None, [
        MuslinCloth, c_void_p, POINTER(MuslinVec3), POINTER(MuslinVec3),
    ]),
    ("muslin_cloth_pin", None, [MuslinCloth, c_uint32, POINTER(MuslinVec3)]),
    ("muslin_cloth_unpin", None, [MuslinCloth, c_uint32]),
    ("muslin_cloth_unpin_all", None, [MuslinCloth]),
    ("muslin_cloth_set_pin_targets", None, [MuslinCloth, c_void_p, c_void_p, c_uint32, c_uint32]),
    ("muslin_cloth_set_pin_stiffness", None, [MuslinCloth, c_void_p, c_uint32, c_float]),
    ("muslin_cloth_get_pins", None, [MuslinCloth, c_void_p, c_uint32, c_void_p]),
    ("muslin_cloth_get_pin_targets", None, [MuslinCloth, c_void_p, c_void_p, c_uint32, c_uint32]),
    ("muslin_cloth_set_mass_scales", None, [MuslinCloth, c_void_p, c_void_p, c_uint32]),
    ("muslin_cloth_set_map", None, [MuslinCloth, c_uint32, c_void_p, c_uint32]),
    ("muslin_cloth_get_map", None, [MuslinCloth, c_uint32, c_void_p, c_uint32, c_void_p]),
    ("muslin_cloth_set_position", None, [MuslinCloth, c_uint32, MuslinVec3]),
    ("muslin_cloth_set_velocity", None, [MuslinCloth, c_uint32, MuslinVec3]),
    ("muslin_cloth_set_positions", None, [MuslinCloth, c_uint32, c_uint32, c_void_p, c_uint32]),
    ("muslin_cloth_set_velocities", None, [MuslinCloth, c_uint32, c_uint32, c_void_p, c_uint32]),
    ("muslin_cloth_get_velocities", None, [MuslinCloth, c_uint32, c_uint32, c_void_p, c_uint32]),
    ("muslin_cloth_get_rest_positions", None, [
        MuslinCloth, c_uint32, c_uint32, c_void_p, c_uint32,
    ]),
    ("muslin_cloth_attach", None, [
        MuslinCloth, c_void_p, c_uint32, MuslinVec3, MuslinQuat, POINTER(MuslinAttachment),
    ]),
    ("muslin_cloth_move_attachment", None, [MuslinCloth, MuslinAttachment, MuslinVec3, MuslinQuat]),
    ("muslin_cloth_detach", None, [MuslinCloth, MuslinAttachment]),
    ("muslin_cloth_set_max_distances", None, [MuslinCloth, c_void_p, c_void_p, c_uint32]),
    ("muslin_cloth_set_backstops", None, [MuslinCloth, c_void_p, c_void_p, c_void_p, c_uint32]),
    ("muslin_cloth_set_anchors", None, [
        MuslinCloth, c_void_p, c_void_p, c_void_p, c_uint32, c_uint32,
    ]),
    ("muslin_cloth_clear_leashes", None, [MuslinCloth]),
    ("muslin_cloth_raycast", None, [
        MuslinCloth, MuslinVec3, MuslinVec3, c_float, POINTER(MuslinHit),
    ]),
    ("muslin_cloth_grab_ray", None, [
        MuslinCloth, MuslinVec3, MuslinVec3, c_float, POINTER(MuslinGrab), POINTER(MuslinVec3),
    ]),
    ("muslin_cloth_grab_particle", None, [MuslinCloth, c_uint32, POINTER(MuslinGrab)]),
    ("muslin_cloth_move_grab", None, [MuslinCloth, MuslinGrab, MuslinVec3]),
    ("muslin_cloth_release", None, [MuslinCloth, MuslinGrab]),
    ("muslin_cloth_tear_edge", None, [MuslinCloth, c_uint32, c_uint32]),
    ("muslin_cloth_crease", None, [MuslinCloth, MuslinVec3, MuslinVec3, c_float]),
    ("muslin_cloth_cut", None, [MuslinCloth, MuslinVec3, MuslinVec3, MuslinVec3, c_void_p]),
    ("muslin_cloth_next_event", None, [MuslinCloth, POINTER(MuslinEvent), c_void_p]),
    ("muslin_cloth_add_collider", None, [
        MuslinCloth, POINTER(MuslinColliderDesc), POINTER(MuslinCollider),
    ]),
    ("muslin_cloth_move_collider", None, [MuslinCloth, MuslinCollider, MuslinVec3, MuslinQuat]),
    ("muslin_cloth_update_collider", None, [
        MuslinCloth, MuslinCollider, c_void_p, c_uint32, c_uint32,
    ]),
    ("muslin_cloth_collide_with", None, [MuslinCloth, MuslinCloth, POINTER(MuslinCollider)]),
    ("muslin_cloth_remove_collider", None, [MuslinCloth, MuslinCollider]),
    ("muslin_cloth_get_collider_pose", None, [
        MuslinCloth, MuslinCollider, POINTER(MuslinVec3), POINTER(MuslinQuat),
    ]),
    ("muslin_cloth_get_collider_impulse", None, [
        MuslinCloth, MuslinCollider, POINTER(MuslinVec3), POINTER(MuslinVec3),
    ]),
    ("muslin_cloth_set_frame", None, [MuslinCloth, MuslinVec3, MuslinQuat]),
    ("muslin_cloth_teleport", None, [MuslinCloth, MuslinVec3, MuslinQuat]),
    ("muslin_cloth_move_frame", None, [MuslinCloth, MuslinVec3, MuslinQuat, c_float]),
    ("muslin_cloth_teleport_collider", None, [MuslinCloth, MuslinCollider, MuslinVec3, MuslinQuat]),
    ("muslin_cloth_view", None, [MuslinCloth, POINTER(MuslinView)]),
    ("muslin_cloth_get_origin", None, [MuslinCloth, POINTER(MuslinVec3)]),
    ("muslin_cloth_changes", None, [MuslinCloth, c_uint32, POINTER(MuslinChanges)]),
    ("muslin_cloth_get_mesh_report", None, [MuslinCloth, POINTER(MuslinMeshReport)]),
    ("muslin_cloth_get_mesh_warnings", None, [MuslinCloth, c_void_p, c_size_t, c_void_p]),
    ("muslin_cloth_get_stats", None, [MuslinCloth, POINTER(MuslinStats)]),
    ("muslin_cloth_state_hash", None, [MuslinCloth, c_void_p]),
    ("muslin_cloth_write_vertices", None, [
        MuslinCloth, POINTER(MuslinStream), c_uint32, POINTER(MuslinWriteDesc),
    ]),
    ("muslin_cloth_write_indices", None, [
        MuslinCloth, c_void_p, c_size_t, c_uint32, c_uint32, c_uint32,
    ]),
    ("muslin_cloth_sew", None, [MuslinCloth, c_void_p, c_uint32, POINTER(MuslinSewDesc)]),
    ("muslin_skin_create", None, [MuslinCloth, POINTER(MuslinSkinDesc), POINTER(MuslinSkin)]),
    ("muslin_skin_write_vertices", None, [
        MuslinSkin, POINTER(MuslinStream), c_uint32, POINTER(MuslinWriteDesc),
    ]),
    ("muslin_skin_view", None, [MuslinSkin, POINTER(MuslinView)]),
    ("muslin_skin_destroy", None, [MuslinSkin]),
    ("muslin_cloth_save", None, [MuslinCloth, c_void_p, c_size_t, c_void_p]),
    ("muslin_cloth_restore", None, [c_void_p, c_size_t, POINTER(MuslinCloth)]),
    ("muslin_settings_init_sized", None, [POINTER(MuslinSettings), c_uint32]),
    ("muslin_material_init_sized", None, [POINTER(MuslinMaterial), c_uint32]),
    ("muslin_wind_init_sized", None, [POINTER(MuslinWind), c_uint32]),
    ("muslin_collider_desc_init_sized", None, [POINTER(MuslinColliderDesc), c_uint32]),
    ("muslin_stream_init_sized", None, [POINTER(MuslinStream), c_uint32]),
    ("muslin_write_desc_init_sized", None, [POINTER(MuslinWriteDesc), c_uint32]),
    ("muslin_sew_desc_init_sized", None, [POINTER(MuslinSewDesc), c_uint32]),
    ("muslin_skin_desc_init_sized", None, [POINTER(MuslinSkinDesc), c_uint32]),
    ("muslin_grid_desc_init_sized", None, [POINTER(MuslinGridDesc), c_uint32, c_uint32, c_uint32]),
    ("muslin_mesh_desc_init_sized", None, [POINTER(MuslinMeshDesc), c_uint32, c_uint32, c_uint32]),
]

NAMES: Final = [name for name, _, _ in _SIGNATURES]


def declare(library: CDLL, check: Callable[[int, Any, Any], int]) -> None:
    """Sets the types of all functions. `check` receives each status that one returns."""
    for name, result, parameters in _SIGNATURES:
        function = getattr(library, name)
        function.argtypes = parameters
        function.restype = c_uint32 if result is None else result
        if result is None:
            function.errcheck = check
