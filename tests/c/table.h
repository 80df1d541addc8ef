/* The rows of table.c, and structs with one invalid field. */
#pragma once

#include "check.h"

/* Calls `function` with an invalid `argument`. */
#define ROW(function, argument, status, words, given)     \
  do {                                                    \
    const uint64_t before = hash();                       \
    REFUSED(function given, status, words);               \
    CHECK(hash() == before && word == 7);                 \
    rows++;                                               \
  } while (0)

/* `function` accepts any `argument`. */
#define ANY(function, argument) (void)(function)

/* Calls `function` with a handle of no cloth. */
#define OF_NONE(function, given) ROW(function, cloth, HANDLE, "`cloth`", given)

/* An initialised struct with one field changed. */
#define BEGUN(type, name, field, value) \
  type name;                            \
  BEGIN_##type(&name);                  \
  name.field = value
#define BEGIN_MuslinGridDesc muslin_grid_desc_init
#define BEGIN_MuslinMeshDesc muslin_mesh_desc_init
#define BEGIN_MuslinSettings muslin_settings_init
#define BEGIN_MuslinMaterial muslin_material_init
#define BEGIN_MuslinWind muslin_wind_init
#define BEGIN_MuslinColliderDesc muslin_collider_desc_init
#define BEGIN_MuslinWriteDesc muslin_write_desc_init
#define BEGIN_MuslinSkinDesc muslin_skin_desc_init
#define BEGIN_MuslinSewDesc muslin_sew_desc_init
