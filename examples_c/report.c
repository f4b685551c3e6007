#include "report.h"

#include "diagnostics.h"
#include "json.h"
#include "system.h"

#include <inttypes.h>
#include <stdlib.h>

static void write_number(FILE *file, const char *name, double value, const char *end) {
    fprintf(file, "\"%s\": ", name);
    json_number(file, value);
    fputs(end, file);
}

static void write_work(FILE *file, const char *name, const BespokeStageReport *work) {
    fprintf(file, "    \"%s\": { ", name);
    write_number(file, "seconds", work->seconds, ", ");
    fprintf(file, "\"iterations\": %" PRIu32 ", \"factorisations\": %" PRIu32 ", \"symbolic_factorisations\": %" PRIu32 " },\n",
            work->iterations, work->factorisations, work->symbolic_factorisations);
}

/* Mean and maximum over the garment's triangles; nothing where nothing has moved yet. */
static bool write_distortion(const BespokeSession *session, FILE *file) {
    size_t count = 0;
    BespokeBuffer buffer = {NULL, 0, 0, BESPOKE_COMPONENT_F64};
    const BespokeStatus status = bespoke_session_read_distortion(session, &buffer, &count);
    if (status != BESPOKE_STATUS_OK) {
        return status == BESPOKE_STATUS_INVALID_STATE;
    }
    double *values = array_new(count, sizeof *values);
    buffer.data = values;
    buffer.capacity = count;
    if (values == NULL || bespoke_session_read_distortion(session, &buffer, NULL) != BESPOKE_STATUS_OK) {
        free(values);
        return false;
    }
    double sum = 0.0, largest = 0.0;
    for (size_t k = 0; k < count; k++) {
        sum += values[k];
        largest = values[k] > largest ? values[k] : largest;
    }
    free(values);
    fputs("  \"distortion\": { ", file);
    write_number(file, "mean", sum / (double)count, ", ");
    write_number(file, "max", largest, " },\n");
    return true;
}

/* All that the library measured. */
static bool write_measurements(const BespokeSession *session, double seconds, FILE *file, Message *message) {
    BespokeReport report = {.struct_size = sizeof report};
    if (bespoke_session_read_report(session, &report) != BESPOKE_STATUS_OK) {
        return fail(message, "the report cannot be read");
    }
    fprintf(file, "  \"threads\": %" PRIu32 ",\n  ", report.threads);
    write_number(file, "seconds", seconds, ",\n  ");
    fprintf(file, "\"memory_bytes\": %" PRIu64 ",\n  ", report.memory_bytes);
    fprintf(file, "\"peak_memory_bytes\": %" PRIu64 ",\n  \"stages\": {\n", system_peak_memory());
    write_work(file, "prepare", &report.prepare);
    write_work(file, "inflate", &report.inflate);
    write_work(file, "repose", &report.repose);
    write_work(file, "fit", &report.fit);
    fputs("    \"rigs\": { ", file);
    write_number(file, "seconds", report.rig_seconds, " },\n");
    fputs("    \"verify\": { ", file);
    write_number(file, "seconds", report.verify_seconds, " },\n");
    fputs("    \"distance_field\": { ", file);
    write_number(file, "seconds", report.field_seconds, " }\n  },\n  \"energies\": {\n");
    for (uint32_t k = 0; k < report.energy_count; k++) {
        BespokeEnergy energy = {.struct_size = sizeof energy};
        if (bespoke_session_read_energy(session, k, &energy) != BESPOKE_STATUS_OK) {
            return fail(message, "the report cannot be read");
        }
        fprintf(file, "    \"%s\": { ", energy.name);
        write_number(file, "value", energy.value, ", ");
        write_number(file, "weight", energy.weight, ", ");
        write_number(file, "weighted", energy.weight * energy.value, k + 1 < report.energy_count ? " },\n" : " }\n");
    }
    fputs("  },\n  ", file);
    write_number(file, "t", report.t, ",\n  ");
    write_number(file, "gradient_norm", report.gradient_norm, ",\n");
    fputs("  \"min_distance\": { ", file);
    write_number(file, "garment_garment", report.garment_distance, ", ");
    write_number(file, "garment_avatar", report.avatar_distance, " },\n");
    if (!write_distortion(session, file)) {
        return fail(message, "the distortion cannot be read");
    }
    fprintf(file, "  \"active_contacts\": %" PRIu64 ",\n", report.active_contacts);
    fputs("  ", file);
    write_number(file, "min_separation", report.min_separation, ",\n");
    fprintf(file, "  \"converged\": %s,\n", report.is_converged != 0 ? "true" : "false");
    fprintf(file, "  \"verified\": %s,\n", report.is_verified != 0 ? "true" : "false");
    fprintf(file,
            "  \"intersections\": { \"garment_garment\": %" PRIu64 ", \"garment_avatar\": %" PRIu64
            ", \"garment_garment_at_start\": %" PRIu64 " },\n",
            report.garment_intersections, report.avatar_intersections, report.initial_self_intersections);
    fprintf(file, "  \"garment\": { \"vertices\": %" PRIu64 ", \"triangles\": %" PRIu64 " },\n", report.garment_vertices,
            report.garment_triangles);
    fprintf(file, "  \"avatar\": { \"vertices\": %" PRIu64 ", \"triangles\": %" PRIu64 " },\n", report.avatar_vertices,
            report.avatar_triangles);
    fprintf(file, "  \"subdivided_avatar\": { \"vertices\": %" PRIu64 ", \"triangles\": %" PRIu64 " },\n",
            report.subdivided_avatar_vertices, report.subdivided_avatar_triangles);
    return true;
}

bool report_write(const Session *session, const char *status, const char *said, FILE *file, Message *message) {
    fprintf(file, "{\n  \"library_version\": \"%s\",\n  \"status\": \"%s\",\n  \"message\": ", bespoke_version_text(),
            status);
    json_text(file, said);
    fputs(",\n", file);
    /* After a defect of the library there is nothing to be read any more. */
    if (session->status != BESPOKE_STATUS_INTERNAL &&
        !write_measurements(session->handle, session_seconds(session), file, message)) {
        return false;
    }
    fputs("  \"diagnostics\": ", file);
    if (!diagnostics_write(session->handle, file, message)) {
        return false;
    }
    fputs("\n}\n", file);
    return true;
}
