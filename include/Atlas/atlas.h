/* SPDX-License-Identifier: MIT */
#ifndef ATLAS_ATLAS_H
#define ATLAS_ATLAS_H

/**
 * \file
 * \brief Atlas for C, and for all languages that call C. C89; link with `Atlas::C`, a shared library.
 *
 * Meshes go into a scene, `atlas_generate()` makes one atlas of all of them, and `atlas_get_result()` gives
 * coordinates on the meshes as they were.
 *
 * - Functions that can fail return one of `ATLAS_OK` ...; for a sentence on what went wrong see
 *   `atlas_error()`. No exception leaves them, and nothing is printed.
 * - Arrays that go in are copied. Arrays that come out belong to the scene, until the next call that changes
 * it.
 * - Every struct starts with its size, so that programs and libraries of different age understand each other:
 *   set it with the `_INIT` macro below. Members that are added later come last, and zero asks for nothing.
 * - Different scenes may be used by different threads at the same time, one scene by one thread at a time.
 * - Integers are 32 bits wide, `ATLAS_NONE` stands for no such thing. Coordinates are in [0, 1]^2 of their
 * page, origin bottom left.
 */

#include <stddef.h>

#if defined(_WIN32)
#if defined(ATLAS_C_BUILD)
#define ATLAS_API __declspec(dllexport)
#else
#define ATLAS_API __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define ATLAS_API __attribute__((visibility("default")))
#else
/** Marks what the shared library shows. */
#define ATLAS_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/** No number: of a face without a chart, and the like. */
#define ATLAS_NONE 0xFFFFFFFFu

/** How a call ended. Positive: there is no fault of the caller, but not what was hoped for. */
enum {
  ATLAS_OK = 0,                /**< done; coordinates are proved to be free of flips and overlaps */
  ATLAS_NOT_VALID = 1,         /**< done, but the certificate in the report names faults */
  ATLAS_NO_SURFACE = 2,        /**< no face has an area */
  ATLAS_NO_ROOM = 3,           /**< the pages have no room for the charts */
  ATLAS_CANCELLED = 4,         /**< by the callback */
  ATLAS_OUT_OF_TIME = 5,       /**< not finished within the time limit */
  ATLAS_INVALID_ARGUMENT = -1, /**< the caller's fault, found before any work */
  ATLAS_OUT_OF_MEMORY = -2,
  ATLAS_FAILED = -3 /**< a fault of the library or of the machine */
};

/** Types of positions. */
enum { ATLAS_FLOAT = 0, ATLAS_DOUBLE = 1 };

/** What matters most. */
enum { ATLAS_MODE_STANDARD = 0, ATLAS_MODE_FEW_SEAMS = 1, ATLAS_MODE_CONFORMAL = 2, ATLAS_MODE_PAPER = 3 };

/** What `max_distortion` is about. */
enum {
  ATLAS_MEASURE_OF_MODE = 0,
  ATLAS_MEASURE_SYMMETRIC_DIRICHLET = 1,
  ATLAS_MEASURE_L2_STRETCH = 2,
  ATLAS_MEASURE_LINF_STRETCH = 3,
  ATLAS_MEASURE_AREA_RATIO = 4,
  ATLAS_MEASURE_AREA_RATIO_QUANTILES = 5,
  ATLAS_MEASURE_QUASI_CONFORMAL = 6
};

/** At which planes charts become mirror images of each other, where the surface is its own. */
enum {
  ATLAS_SYMMETRY_OFF = 0,
  ATLAS_SYMMETRY_AUTO = 1, /**< at the best plane there is */
  ATLAS_SYMMETRY_X = 2,
  ATLAS_SYMMETRY_Y = 3,
  ATLAS_SYMMETRY_Z = 4
};

/** From whom seams are hidden. */
enum {
  ATLAS_HIDE_NONE = 0,
  ATLAS_HIDE_OPENNESS = 1, /**< from viewers all around: seams run where the model shades itself */
  ATLAS_HIDE_DOME = 2,     /**< from viewers in the half-space towards `hide_axis` */
  ATLAS_HIDE_VIEW = 3      /**< from viewers who look about along `hide_axis`, from its tip to the model */
};

/** How charts may turn on the page. */
enum {
  ATLAS_ROTATION_ALIGNED = 0, /**< those with a dominant direction parallel to an axis, others as they like */
  ATLAS_ROTATION_FREE = 1,
  ATLAS_ROTATION_ANY = 2, /**< aligned, but as they like where that makes the page fuller */
  ATLAS_ROTATION_QUARTER = 3,
  ATLAS_ROTATION_NONE = 4
};

/** Which charts may lie on top of each other. */
enum { ATLAS_STACK_NONE = 0, ATLAS_STACK_COPIES = 1, ATLAS_STACK_MIRRORED = 2 };

/** How long to look for a tighter packing. */
enum { ATLAS_EFFORT_FAST = 0, ATLAS_EFFORT_NORMAL = 1, ATLAS_EFFORT_BEST = 2 };

/** The stages of `atlas_generate()`. */
enum {
  ATLAS_STAGE_SEGMENTATION = 0,
  ATLAS_STAGE_PARAMETERIZATION = 1,
  ATLAS_STAGE_PACKING = 2,
  ATLAS_STAGE_VERIFICATION = 3
};

/** Meshes that share one atlas, and the atlas. */
typedef struct atlas_scene atlas_scene;

/**
 * Told that `fraction` in [0, 1] of a stage is done; returns 0 to cancel. Called from one thread at a time,
 * not always the one that called.
 */
typedef int (*atlas_progress)(void* user, int stage, double fraction);

/** A mesh of any polygons. Pointers may be null but for `positions` and `indices`. */
typedef struct atlas_mesh
{
  size_t size;                    /**< of this struct */
  const void* positions;          /**< three numbers per vertex */
  int position_type;              /**< `ATLAS_FLOAT` or `ATLAS_DOUBLE` */
  size_t position_stride;         /**< bytes from one vertex to the next; 0: there is nothing in between */
  size_t number_of_vertices;      /**< how many there are */
  const unsigned int* indices;    /**< the vertices of all corners, face by face */
  const unsigned int* face_sizes; /**< corners per face; null: triangles */
  size_t number_of_faces;         /**< how many there are */
  const float* vertex_uvs;        /**< coordinates that there are: two numbers per vertex, ... */
  const float* corner_uvs;        /**< ... or two per corner; NaN where there are none */
  const unsigned int* face_pages; /**< pages of these coordinates; null: all on page 0 */
  const unsigned int* face_materials;  /**< any numbers, with one meaning in all of the scene */
  const unsigned int* seams;           /**< edges that must be seams, two vertices each */
  size_t number_of_seams;              /**< how many there are */
  const unsigned int* forbidden_seams; /**< edges that must not be seams, as far as topology allows */
  size_t number_of_forbidden_seams;    /**< how many there are */
  const double* visibility;      /**< how much each vertex is seen, in [0, 1]: seams run where it is small */
  const unsigned char* selected; /**< per face: not 0 if it is unwrapped anew; all others keep their
                                    coordinates, in [0, 1]^2 of their pages, to the bit. Null: all are */
  const unsigned char* pinned;   /**< per corner: not 0 if it keeps its coordinates, in [0, 1]^2 of the first
                                    page; charts follow. What could not be kept is in `moved_pins` of the
                                    report. Null: none is pinned */
} atlas_mesh;

/** What the charts of a material may do. */
typedef struct atlas_material_rule
{
  unsigned int material; /**< which one */
  double weight;         /**< so many times the density of the others; 1 is usual */
  int is_grouped; /**< charts keep the places beside each other that they have in the coordinates that there
                     are */
  int is_locked;  /**< charts stay where they are */
} atlas_material_rule;

/** What is asked for. `ATLAS_OPTIONS_INIT()` sets the defaults. */
typedef struct atlas_options
{
  size_t size;              /**< of this struct */
  int mode;                 /**< `ATLAS_MODE_...` */
  int measure;              /**< `ATLAS_MEASURE_...` */
  double max_distortion;    /**< bound under which charts merge, at least 1; 0: that of the mode */
  double max_stretch;       /**< bound on the stretch of single triangles, at least 1; 0: that of the mode */
  double max_stretch_share; /**< the share of each chart's area that has to keep it; 0: that of the mode */
  size_t max_charts;        /**< merge on until there are at most so many; 0: no such wish */
  double min_chart_texels;  /**< merge charts of fewer texels with a neighbour; 0: no such wish */
  double hard_angle;        /**< cut at edges sharper than so many degrees; 0: none */
  int straighten;           /**< make rectangles of regular grids of quadrilaterals */
  int separate_materials;   /**< no chart has faces of two materials */
  int keep_uvs;             /**< keep the shapes of the charts that the coordinates of the meshes have */
  int orient;         /**< turn faces around first, so that neighbours agree; `indices` are of turned faces */
  unsigned int width; /**< of a page in texels, from 1 to 65536 */
  unsigned int height;     /**< of a page in texels */
  double gutter;           /**< least distance between two charts in texels; half of it to the border */
  unsigned int mip_levels; /**< keep charts apart down to this level of a mip-map */
  unsigned int block;      /**< no two charts share a block of so many texels squared */
  unsigned int pages;      /**< how many may be filled */
  double density;          /**< texels per unit, on as many pages as that takes; 0: the largest that fits */
  int rotation;            /**< `ATLAS_ROTATION_...` */
  double up[3];            /**< what is up in space, and then on the page; 0: no such wish */
  int snap;                /**< straight borders of charts lie on borders of texels */
  int free_aspect;         /**< the page may have another ratio of its sides */
  int stack;               /**< `ATLAS_STACK_...` */
  int effort;              /**< `ATLAS_EFFORT_...` */
  const atlas_material_rule* rules; /**< rules for materials, or NULL */
  size_t number_of_rules;           /**< how many there are */
  unsigned int threads;             /**< 0: all cores. The result does not depend on it */
  double time_limit;                /**< seconds; 0: none */
  atlas_progress progress;          /**< called with how far the work is, or NULL */
  void* user;                       /**< handed to `progress` */
  double min_coverage; /**< charts are cut until they cover this share of the pages; 0: no such wish */
  double min_texels_per_chart; /**< smaller charts are enlarged; 0: no such wish */
  double seam_exchange_rate;   /**< charts are cut where the density rises by so much for the seam; negative:
                                  that of the mode */
  int symmetry;                /**< `ATLAS_SYMMETRY_...` */
  int hide_seams;              /**< `ATLAS_HIDE_...`; besides, meshes may have their `visibility` */
  double hide_axis[3];         /**< from the model to the viewers, of any length but 0 */
  /** Models of stages by the names that `texture_atlas --help` lists, such as "seams"; NULL: the mode's. */
  const char* segmentation;
  const char* parameterizer; /**< who flattens charts, such as "lscm" or "abf" */
  const char* solver;        /**< of the linear system of LSCM */
  const char* pins;          /**< which two vertices LSCM pins */
  const char* optimizer;     /**< who lowers the distortion of flattened charts */
  const char* packer;        /**< who puts charts on pages */
  int only_given_seams; /**< charts are what seams, `hard_angle` and materials make, whatever their distortion
                         */
  double weld; /**< vertices nearer than this share of their mesh's size are one, in [0, 0.1]; 0: only equal
                  ones */
  int defragment; /**< merge the charts that the coordinates of the meshes have, within the bounds; a chart
                     that merges with none keeps its shape */
} atlas_options;

/** The figures of the atlas. */
typedef struct atlas_summary
{
  size_t size;             /**< of this struct */
  size_t number_of_charts; /**< of all meshes */
  size_t number_of_pages;  /**< that have charts on them */
  /** Width of a page in texels. */
  unsigned int width, height; /**< height of a page in texels */
  double texels_per_unit;     /**< unit of the model */
  double efficiency;          /**< share of the pages that is covered, in [0, 1] */
} atlas_summary;

/** What became of a mesh. Faces and corners are those of the mesh, in the same order. */
typedef struct atlas_result
{
  size_t size; /**< of this struct */
  /** How many faces there are. */
  size_t number_of_faces, number_of_corners; /**< how many corners all faces have together */
  const float* corner_uvs;                   /**< two per corner */
  const unsigned int*
      face_charts; /**< charts count from 0 over the whole scene; `ATLAS_NONE`: the face was rejected */
  const unsigned int* face_pages; /**< per face: its page */

  /* The same with one pair of coordinates per vertex; vertices at seams occur several times. */
  size_t number_of_vertices;    /**< how many there are */
  const unsigned int* vmapping; /**< per new vertex: the vertex of the mesh that it was */
  const float* uvs;             /**< two per new vertex */
  const unsigned int* indices;  /**< per corner: its new vertex */

  /* The triangles that the polygons were taken for, without those of rejected faces. */
  size_t number_of_triangles;           /**< how many there are */
  const unsigned int* triangles;        /**< three new vertices per triangle */
  const unsigned int* face_of_triangle; /**< per triangle: its face */
} atlas_result;

/** "major.minor.patch" of the library. */
ATLAS_API const char* atlas_version(void);

/** A sentence on one of `ATLAS_OK` ...; never null. */
ATLAS_API const char* atlas_message(int status);

/** The name of a stage; never null. */
ATLAS_API const char* atlas_stage_name(int stage);

/** An empty scene; null if there is no memory for it. */
ATLAS_API atlas_scene* atlas_create(void);

/** Ends a scene. Null is none. */
ATLAS_API void atlas_destroy(atlas_scene* scene);

/** What went wrong in the last call of this scene, as one sentence; empty if nothing did. Never null. */
ATLAS_API const char* atlas_error(const atlas_scene* scene);

/** Sets the defaults and the size. See `ATLAS_OPTIONS_INIT()`. */
ATLAS_API int atlas_init_options(atlas_options* options, size_t size);

/** Empties a mesh, a summary or a result and sets its size. See `ATLAS_MESH_INIT()` and so on. */
ATLAS_API int atlas_init(void* object, size_t size);

/** Gives all options their defaults. */
#define ATLAS_OPTIONS_INIT(options) atlas_init_options((options), sizeof(atlas_options))
/** An empty mesh. */
#define ATLAS_MESH_INIT(mesh) atlas_init((mesh), sizeof(atlas_mesh))
/** Prepares a summary to be filled. */
#define ATLAS_SUMMARY_INIT(summary) atlas_init((summary), sizeof(atlas_summary))
/** Prepares a result to be filled. */
#define ATLAS_RESULT_INIT(result) atlas_init((result), sizeof(atlas_result))

/** Adds a mesh. Meshes count from 0. */
ATLAS_API int atlas_add_mesh(atlas_scene* scene, const atlas_mesh* mesh);

/** How many meshes the scene has. */
ATLAS_API size_t atlas_number_of_meshes(const atlas_scene* scene);

/** Makes the atlas: charts, coordinates, pages, proof. \param options null: the defaults */
ATLAS_API int atlas_generate(atlas_scene* scene, const atlas_options* options);

/** Packs the coordinates that the meshes came with anew; the shapes of charts stay as they are. */
ATLAS_API int atlas_pack(atlas_scene* scene, const atlas_options* options);

/**
 * Examines the coordinates that the meshes came with, under `width`, `height` and `gutter` of the options;
 * with null any distance will do, a gutter of 0. The report is the certificate; there are no results.
 */
ATLAS_API int atlas_verify(atlas_scene* scene, const atlas_options* options);

/** The report on the last of these three as JSON; "null" if there is none. Never null. */
ATLAS_API const char* atlas_report(const atlas_scene* scene);

/** The figures of the last of these three. */
ATLAS_API int atlas_get_summary(atlas_scene* scene, atlas_summary* summary);

/** The coordinates of a mesh, after `atlas_generate()` or `atlas_pack()` gave `ATLAS_OK` or
 * `ATLAS_NOT_VALID`. */
ATLAS_API int atlas_get_result(atlas_scene* scene, size_t mesh, atlas_result* result);

#ifdef __cplusplus
}
#endif

#endif
