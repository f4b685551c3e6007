/* What differs between systems: the words of the command line, files by their names, clocks, and being asked to stop. Text is
   UTF-8 everywhere, and so are names of files. */
#ifndef SYSTEM_H
#define SYSTEM_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

/* The words of the command line in UTF-8, from the words that main was given; null without memory. To be called first: what is
   printed is not changed on its way from here on. */
char **system_words(int *count, char **words);
void system_words_free(char **words, char **given);

/* As fopen. */
FILE *system_open(const char *path, const char *mode);
bool system_is_folder(const char *path);

/* Calls `stop` once somebody asks the process to end: with 2 for Ctrl-C, 15 and 1 for the signals of these numbers, and what
   on other systems comes closest. It may be called at any time and on any thread. */
void system_on_stop(void (*stop)(int number));

bool system_is_terminal(void);

/* Of a clock that nobody sets. */
double system_seconds(void);

/* In bytes; 0 where it is not known. */
uint64_t system_peak_memory(void);

#endif
