/* Plain text tables: skin weights and lists of vertices. */
#ifndef NUMBERS_H
#define NUMBERS_H

#include "text.h"

/* A matrix, one row a line. Everything after a # is a comment. */
typedef struct Matrix {
    float *values; /* row after row */
    size_t rows;
    size_t columns;
} Matrix;

bool matrix_read(Matrix *matrix, const char *path, Message *message);
void matrix_free(Matrix *matrix);

/* Whole numbers from 0, separated by blanks or line breaks. Lines without any are no rows. */
typedef struct List {
    uint32_t *values; /* row after row */
    size_t count;
    size_t *ends; /* where each row ends in values */
    size_t rows;
} List;

bool list_read(List *list, const char *path, Message *message);
void list_free(List *list);

#endif
