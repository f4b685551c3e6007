/* The command line of retarget. */
#ifndef OPTIONS_H
#define OPTIONS_H

#include <stdint.h>

#include "text.h"

typedef struct Options {
    const char *garment;
    const char *source_skeleton;
    const char *avatar;
    const char *target_skeleton;
    const char *output;
    /* The rest may be null. */
    const char *source_avatar;
    const char *skin_weights;
    const char *no_fit;
    const char *pins;
    const char *rigid;
    const char *output_avatar;
    const char *report;
    const char *distortion;
    const char *keep_partial;
    /* Beside keep_partial, made from its name. */
    char *partial_avatar;
    /* Garments that the avatar wears already. */
    const char **layers;
    size_t layer_count;
    /* Negative: not given. */
    double fit_weight;
    double designed_clearance;
    double offset;
    double fit_distance;
    double pin_weight;
    double surface_weight;
    double curve_weight;
    double curvature_weight;
    double torsion_weight;
    double position_weight;
    double barrier_weight;
    double dhat;
    double inflation_dhat;
    double inflation_barrier_weight;
    double voxel_size;
    double min_separation;
    double tolerance;
    double max_iterations;
    double threads;
    double memory_limit;
    bool printed_surface;
    bool strict;
    bool quiet;
    bool help;
    bool version;
} Options;

/* Whatever it says, options_free is to be called afterwards. */
bool options_parse(Options *options, int count, char **words, Message *message);

void options_free(Options *options);

/* What --help prints, part after part, up to a null. */
extern const char *const options_usage[];

#endif
