/* The command line of retarget. */
#ifndef OPTIONS_H
#define OPTIONS_H

#include <stdio.h>

#include "bespoke.h"
#include "text.h"

/* What an option names that may be given several times. */
typedef struct Paths {
    const char **paths;
    size_t count;
} Paths;

typedef struct Options {
    const char *garment;
    const char *avatar;
    const char *output;
    /* The rest may be null; of skeleton and rig one is there. */
    const char *source_skeleton;
    const char *target_skeleton;
    const char *source_rig;
    const char *target_rig;
    const char *target_skin;
    const char *source_skin;
    const char *joint_pairs;
    const char *joint_map;
    const char *output_skin;
    const char *output_rig;
    const char *output_covered;
    /* Rings of triangles beside what is not covered, and the share of directions that may be open. */
    uint32_t covered_margin;
    double covered_openness;
    const char *garment_skin;
    const char *source_avatar;
    const char *skin_weights;
    const char *no_fit;
    const char *pins;
    const char *rigid;
    const char *curves;
    /* Where struct_size is 0, none is told. */
    BespokeCoordinateSystem source_space;
    BespokeCoordinateSystem target_space;
    /* Names in the avatar's file, separated by commas. */
    const char *body_groups;
    const char *collision_groups;
    const char *ignore_groups;
    const char *output_avatar;
    const char *report;
    const char *distortion;
    const char *keep_partial;
    /* Beside keep_partial, made from its name. */
    char *partial_avatar;
    /* Garments that the avatar wears already. */
    const char **layers;
    size_t layer_count;
    /* What goes along with the garment. */
    Paths followers;
    Paths garment_morphs;
    Paths target_morphs;
    /* The normals of the garment's file are those of the design. */
    bool garment_normals;
    /* What the library is told: 0 is the default of each. */
    BespokeOptions library;
    /* Curvature and torsion, where they have no weight of their own. */
    double curve_weight;
    bool quiet;
    bool help;
    bool version;
} Options;

/* Whatever it says, options_free is to be called afterwards. */
bool options_parse(Options *options, int count, char **words, Message *message);

void options_free(Options *options);

/* What --help prints. */
void options_print_usage(FILE *file);

/* Its text before and after the options. */
extern const char usage_begin[];
extern const char usage_end[];

#endif
