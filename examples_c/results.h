/* What a run leaves: after a verified end all its files or none, after a failure the report and the partial meshes. */
#ifndef RESULTS_H
#define RESULTS_H

#include "inputs.h"
#include "options.h"
#include "output.h"
#include "session.h"

/* Garment, avatar, distortion, report, skin weights, rig, covered triangles. */
#define RESULTS 7

typedef struct Results {
    Output outputs[RESULTS];
    /* What goes along with the garment. */
    Output *further;
    size_t further_count;
} Results;

/* False, with a message, where one of the files that may have to be written could not be. */
bool results_check(const Options *options, Message *message);

/* Writes all files whole, but under other names; results_commit puts them in their places. False with a message in the
   session. results_discard is to be called in the end, whatever came before. `status` and `said` are for the report. */
bool results_write(Results *results, Session *session, const Inputs *inputs, const Options *options, const char *status,
                   const char *said);
bool results_commit(Results *results, Message *message);
void results_discard(Results *results);

/* Writes what a run without a result leaves behind, and says so on `file`. */
void results_write_failure(Session *session, const Inputs *inputs, const Options *options, FILE *file);

#endif
