#include "obj.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What a file holds in all, counted before anything is stored, so that a face may name a later vertex. */
typedef struct Counts {
    size_t vertices;
    size_t normals;
    size_t faces;
    size_t face_words;
    size_t line_words;
} Counts;

static Counts count_elements(const Text *text) {
    Counts counts = {0, 0, 0, 0, 0};
    for (Line line = line_start(text); line_next(&line, text);) {
        const char *at = line.begin;
        Word word;
        if (!word_next(&word, &at, &line)) {
            continue;
        }
        const bool is_face = word_is(word, "f");
        const bool is_line = word_is(word, "l");
        counts.vertices += word_is(word, "v");
        counts.normals += word_is(word, "vn");
        counts.faces += is_face;
        while ((is_face || is_line) && word_next(&word, &at, &line)) {
            counts.face_words += is_face;
            counts.line_words += is_line;
        }
    }
    return counts;
}

/* The reader at its place in the file. */
typedef struct Reader {
    Obj *obj;
    const char *path;
    Line line;
    size_t vertices_so_far;
    int64_t normals_so_far;
    /* For each vertex its newest normal; for each normal the next older one of its vertex and its vn. */
    uint32_t *newest;
    uint32_t *older;
    int64_t *numbers;
    Message *message;
} Reader;

static bool bad_word(const Reader *reader, Word word, const char *reason) {
    const ptrdiff_t length = word.end - word.begin;
    return fail(reader->message, "%s: line %zu: '%.*s' %s", reader->path, reader->line.number,
                (int)(length > 40 ? 40 : length), word.begin, reason);
}

static bool read_vertex(Reader *reader, const char *at) {
    float *position = reader->obj->positions + 3 * reader->vertices_so_far;
    for (int k = 0; k < 3; k++) {
        Word word;
        double value;
        if (!word_next(&word, &at, &reader->line)) {
            return fail(reader->message, "%s: line %zu: a vertex needs three coordinates and has %d", reader->path,
                        reader->line.number, k);
        }
        if (!word_number(word, &value) || fabs(value) > (double)FLT_MAX) {
            return bad_word(reader, word, "is not a coordinate (a finite 32-bit number)");
        }
        position[k] = (float)value;
    }
    reader->vertices_so_far++;
    return true;
}

/* v, v/vt, v/vt/vn or v//vn. `normal` is the number of the vn, made absolute, or 0 where there is none. */
static bool read_corner(const Reader *reader, Word word, uint32_t *vertex, int64_t *normal) {
    int64_t fields[3] = {0, 0, 0};
    const char *from = word.begin;
    for (int k = 0; k < 3; k++) {
        const char *slash = memchr(from, '/', (size_t)(word.end - from));
        const Word field = {from, slash != NULL && k < 2 ? slash : word.end};
        if (!(k > 0 && field.begin == field.end) && (!word_integer(field, &fields[k]) || fields[k] == 0)) {
            return bad_word(reader, word, "is not a corner (v, v/vt, v/vt/vn or v//vn with indices from 1 or below 0)");
        }
        if (field.end == word.end) {
            break;
        }
        from = field.end + 1;
    }
    const int64_t count = (int64_t)reader->obj->vertex_count;
    const int64_t index = fields[0] > 0 ? fields[0] - 1 : (int64_t)reader->vertices_so_far + fields[0];
    if (index < 0 || index >= count) {
        char reason[96];
        snprintf(reason, sizeof reason, "names a vertex that does not exist (the file has %zu)", (size_t)count);
        return bad_word(reader, word, reason);
    }
    *vertex = (uint32_t)index;
    *normal = fields[2] >= 0 ? fields[2] : reader->normals_so_far + 1 + fields[2];
    return fields[2] == 0 || *normal > 0 || bad_word(reader, word, "names a vertex normal that does not exist");
}

/* Which of the normals to be written this vertex has under this vn; a new one where it has none yet. */
static uint32_t normal_of(Reader *reader, uint32_t vertex, int64_t number) {
    uint32_t normal = reader->newest[vertex];
    while (normal != OBJ_NO_NORMAL && reader->numbers[normal] != number) {
        normal = reader->older[normal];
    }
    if (normal == OBJ_NO_NORMAL) {
        normal = (uint32_t)reader->obj->normal_count++;
        reader->numbers[normal] = number;
        reader->obj->normal_vn[normal] = number <= (int64_t)UINT32_MAX ? (uint32_t)(number - 1) : UINT32_MAX;
        reader->older[normal] = reader->newest[vertex];
        reader->newest[vertex] = normal;
    }
    return normal;
}

/* What is no direction stays 0: the file is used without it. */
static void read_normal(Reader *reader, const char *at) {
    float *normal = reader->obj->vn + 3 * (size_t)reader->normals_so_far++;
    double values[3];
    for (int k = 0; k < 3; k++) {
        Word word;
        if (!word_next(&word, &at, &reader->line) || !word_number(word, &values[k]) || fabs(values[k]) > (double)FLT_MAX) {
            return;
        }
    }
    for (int k = 0; k < 3; k++) {
        normal[k] = (float)values[k];
    }
}

static bool read_face(Reader *reader, const char *at) {
    Obj *obj = reader->obj;
    Corner *first = obj->corners + obj->corner_count;
    uint32_t size = 0;
    for (Word word; word_next(&word, &at, &reader->line); size++) {
        int64_t number;
        if (!read_corner(reader, word, &first[size].vertex, &number)) {
            return false;
        }
        first[size].normal = number == 0 ? OBJ_NO_NORMAL : normal_of(reader, first[size].vertex, number);
        if (size >= 2) {
            uint32_t *triangle = obj->triangles + 3 * obj->triangle_count++;
            triangle[0] = first[0].vertex;
            triangle[1] = first[size - 1].vertex;
            triangle[2] = first[size].vertex;
        }
    }
    if (size < 3) {
        return fail(reader->message, "%s: line %zu: a face needs three corners and has %u", reader->path,
                    reader->line.number, (unsigned)size);
    }
    obj->corner_count += size;
    obj->face_sizes[obj->face_count++] = size;
    return true;
}

static bool read_polyline(Reader *reader, const char *at) {
    Obj *obj = reader->obj;
    uint32_t last = 0;
    uint32_t size = 0;
    for (Word word; word_next(&word, &at, &reader->line); size++) {
        uint32_t vertex;
        int64_t unused;
        if (!read_corner(reader, word, &vertex, &unused)) {
            return false;
        }
        if (size > 0) {
            uint32_t *segment = obj->segments + 2 * obj->segment_count++;
            segment[0] = last;
            segment[1] = vertex;
        }
        last = vertex;
    }
    return size >= 2 || fail(reader->message, "%s: line %zu: an l line needs two vertices and has %u", reader->path,
                             reader->line.number, (unsigned)size);
}

static bool read_elements(Reader *reader) {
    const Text *text = &reader->obj->text;
    for (reader->line = line_start(text); line_next(&reader->line, text);) {
        const char *at = reader->line.begin;
        Word word;
        bool good = true;
        if (!word_next(&word, &at, &reader->line)) {
            continue;
        } else if (word_is(word, "v")) {
            good = read_vertex(reader, at);
        } else if (word_is(word, "vn")) {
            read_normal(reader, at);
        } else if (word_is(word, "f")) {
            good = read_face(reader, at);
        } else if (word_is(word, "l")) {
            good = read_polyline(reader, at);
        }
        if (!good) {
            return false;
        }
    }
    return true;
}

bool obj_read(Obj *obj, const char *path, Message *message) {
    memset(obj, 0, sizeof *obj);
    if (!text_read(&obj->text, path, message)) {
        return false;
    }
    const Counts counts = count_elements(&obj->text);
    if (counts.vertices == 0) {
        obj_free(obj);
        return fail(message, "%s: has no v lines, so it is no OBJ file with vertices", path);
    }
    if (counts.vertices >= UINT32_MAX || counts.face_words >= UINT32_MAX) {
        obj_free(obj);
        return fail(message, "%s: has more elements than 32-bit indices can count", path);
    }
    Reader reader;
    memset(&reader, 0, sizeof reader);
    reader.obj = obj;
    reader.path = path;
    reader.message = message;
    obj->vertex_count = counts.vertices;
    obj->positions = array_new(counts.vertices, 3 * sizeof(float));
    obj->corners = array_new(counts.face_words, sizeof(Corner));
    obj->triangles = array_new(counts.face_words, 3 * sizeof(uint32_t));
    obj->segments = array_new(counts.line_words, 2 * sizeof(uint32_t));
    obj->face_sizes = array_new(counts.faces, sizeof(uint32_t));
    obj->normal_vn = array_new(counts.face_words, sizeof(uint32_t));
    obj->vn = calloc(counts.normals > 0 ? counts.normals : 1, 3 * sizeof(float));
    obj->vn_count = counts.normals;
    reader.newest = array_new(counts.vertices, sizeof(uint32_t));
    reader.older = array_new(counts.face_words, sizeof(uint32_t));
    reader.numbers = array_new(counts.face_words, sizeof(int64_t));
    bool good = false;
    if (obj->positions == NULL || obj->corners == NULL || obj->triangles == NULL || obj->segments == NULL ||
        obj->face_sizes == NULL || obj->normal_vn == NULL || obj->vn == NULL || reader.newest == NULL || reader.older == NULL || reader.numbers == NULL) {
        fail(message, "%s: does not fit into memory", path);
    } else {
        for (size_t v = 0; v < counts.vertices; v++) {
            reader.newest[v] = OBJ_NO_NORMAL;
        }
        good = read_elements(&reader);
    }
    free(reader.newest);
    free(reader.older);
    free(reader.numbers);
    if (!good) {
        obj_free(obj);
    }
    return good;
}

/* The unit normal of each group of corners that share one: the sum of their faces' area vectors. */
static void compute_normals(const Obj *obj, const float *positions, double *normals) {
    memset(normals, 0, obj->normal_count * 3 * sizeof(double));
    const Corner *corner = obj->corners;
    for (size_t f = 0; f < obj->face_count; corner += obj->face_sizes[f++]) {
        const uint32_t size = obj->face_sizes[f];
        const float *o = positions + 3 * (size_t)corner[0].vertex;
        double area[3] = {0.0, 0.0, 0.0};
        for (uint32_t k = 2; k < size; k++) {
            const float *p = positions + 3 * (size_t)corner[k - 1].vertex;
            const float *q = positions + 3 * (size_t)corner[k].vertex;
            const double a[3] = {(double)p[0] - o[0], (double)p[1] - o[1], (double)p[2] - o[2]};
            const double b[3] = {(double)q[0] - o[0], (double)q[1] - o[1], (double)q[2] - o[2]};
            area[0] += a[1] * b[2] - a[2] * b[1];
            area[1] += a[2] * b[0] - a[0] * b[2];
            area[2] += a[0] * b[1] - a[1] * b[0];
        }
        for (uint32_t k = 0; k < size; k++) {
            if (corner[k].normal != OBJ_NO_NORMAL) {
                double *normal = normals + 3 * (size_t)corner[k].normal;
                normal[0] += area[0];
                normal[1] += area[1];
                normal[2] += area[2];
            }
        }
    }
    for (size_t n = 0; n < obj->normal_count; n++) {
        double *normal = normals + 3 * n;
        const double length = sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
        if (length > 0.0) {
            normal[0] /= length;
            normal[1] /= length;
            normal[2] /= length;
        } else { /* every face at it is degenerate: any direction is as good */
            normal[2] = 1.0;
        }
    }
}

/* These normals instead; one without a length keeps what was computed. */
static void use_normals(const Obj *obj, const float *given, double *normals) {
    for (size_t n = 0; n < obj->normal_count; n++) {
        const float *from = given + 3 * n;
        if (from[0] != 0.0f || from[1] != 0.0f || from[2] != 0.0f) {
            for (int k = 0; k < 3; k++) {
                normals[3 * n + (size_t)k] = (double)from[k];
            }
        }
    }
}

void obj_render_mesh(const Obj *obj, uint32_t *triangles, float *normals) {
    memset(normals, 0, (obj->normal_count + obj->vertex_count) * 3 * sizeof *normals);
    for (size_t n = 0; n < obj->normal_count; n++) {
        if (obj->normal_vn[n] < obj->vn_count) {
            memcpy(normals + 3 * n, obj->vn + 3 * (size_t)obj->normal_vn[n], 3 * sizeof *normals);
        }
    }
    const Corner *corner = obj->corners;
    for (size_t f = 0; f < obj->face_count; corner += obj->face_sizes[f++]) {
        for (uint32_t k = 2; k < obj->face_sizes[f]; k++) {
            const Corner *fan[3] = {&corner[0], &corner[k - 1], &corner[k]};
            for (int c = 0; c < 3; c++) {
                const bool has_normal = fan[c]->normal != OBJ_NO_NORMAL;
                *triangles++ = has_normal ? fan[c]->normal : (uint32_t)obj->normal_count + fan[c]->vertex;
            }
        }
    }
}

static void write_vertex(FILE *file, const Line *line, const char *at, const float *position) {
    Word word;
    for (int k = 0; k < 3; k++) {
        word_next(&word, &at, line);
    }
    fprintf(file, "v %.9g %.9g %.9g", (double)position[0], (double)position[1], (double)position[2]);
    fwrite(at, 1, (size_t)(line->next - at), file);
}

/* The face with its normals counted as written: what stands before the second slash stays. */
static void write_face(FILE *file, const Line *line, const char *at, const Corner *corner, uint32_t size) {
    bool has_normals = false;
    for (uint32_t k = 0; k < size; k++) {
        has_normals = has_normals || corner[k].normal != OBJ_NO_NORMAL;
    }
    if (!has_normals) {
        fwrite(line->begin, 1, (size_t)(line->next - line->begin), file);
        return;
    }
    fputc('f', file);
    for (Word word; word_next(&word, &at, line); corner++) {
        const char *end = word.end;
        if (corner->normal != OBJ_NO_NORMAL) {
            while (end[-1] != '/') {
                end--;
            }
        }
        fputc(' ', file);
        fwrite(word.begin, 1, (size_t)(end - word.begin), file);
        if (corner->normal != OBJ_NO_NORMAL) {
            fprintf(file, "%zu", (size_t)corner->normal + 1);
        }
    }
    fwrite(line->end, 1, (size_t)(line->next - line->end), file);
}

/* The line break of the file where this line stands. */
static const char *break_of(const Line *line) {
    return line->end < line->next && *line->end == '\r' ? "\r\n" : "\n";
}

bool obj_write(const Obj *obj, const float *positions, const float *given, const char *comment, FILE *file,
               Message *message) {
    double *normals = array_new(obj->normal_count, 3 * sizeof(double));
    if (normals == NULL) {
        return fail(message, "the vertex normals do not fit into memory");
    }
    compute_normals(obj, positions, normals);
    if (given != NULL) {
        use_normals(obj, given, normals);
    }
    const Corner *corner = obj->corners;
    size_t vertex = 0;
    size_t face = 0;
    for (Line line = line_start(&obj->text); line_next(&line, &obj->text);) {
        if (comment != NULL) {
            fprintf(file, "# %s%s", comment, break_of(&line));
            comment = NULL;
        }
        const char *at = line.begin;
        Word word;
        if (!word_next(&word, &at, &line)) {
            fwrite(line.begin, 1, (size_t)(line.next - line.begin), file);
        } else if (word_is(word, "v")) {
            write_vertex(file, &line, at, positions + 3 * vertex++);
        } else if (word_is(word, "f")) {
            /* in front of the first face */
            for (size_t n = 0; face == 0 && n < obj->normal_count; n++) {
                const double *normal = normals + 3 * n;
                fprintf(file, "vn %.6f %.6f %.6f", normal[0], normal[1], normal[2]);
                fputs(break_of(&line), file);
            }
            write_face(file, &line, at, corner, obj->face_sizes[face]);
            corner += obj->face_sizes[face++];
        } else if (!word_is(word, "vn")) {
            fwrite(line.begin, 1, (size_t)(line.next - line.begin), file);
        }
    }
    free(normals);
    return true;
}

void obj_free(Obj *obj) {
    text_free(&obj->text);
    free(obj->positions);
    free(obj->corners);
    free(obj->triangles);
    free(obj->segments);
    free(obj->face_sizes);
    free(obj->normal_vn);
    free(obj->vn);
    memset(obj, 0, sizeof *obj);
}
