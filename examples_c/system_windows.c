#ifdef _WIN32
#define WIN32_LEAN_AND_MEAN
#define _WIN32_WINNT 0x0601
#define PSAPI_VERSION 2

#include "system.h"

#include "system_windows.h"

#include <errno.h>
#include <fcntl.h>
#include <io.h>
#include <stdlib.h>
#include <string.h>
#include <windows.h>
#include <psapi.h>
#include <shellapi.h>

static void (*on_stop)(int number) = NULL;
static UINT code_page = 0;

static void restore_console(void) {
    SetConsoleOutputCP(code_page);
}

char *system_narrow(const wchar_t *text) {
    const int size = WideCharToMultiByte(CP_UTF8, 0, text, -1, NULL, 0, NULL, NULL);
    char *narrow = malloc(size > 0 ? (size_t)size : 1);
    if (narrow != NULL) {
        narrow[0] = '\0';
        WideCharToMultiByte(CP_UTF8, 0, text, -1, narrow, size, NULL, NULL);
    }
    return narrow;
}

char **system_words(int *count, char **words) {
    /* The bytes that are written, without a carriage return before each line feed. */
    _setmode(_fileno(stdout), _O_BINARY);
    _setmode(_fileno(stderr), _O_BINARY);
    code_page = GetConsoleOutputCP();
    if (code_page != 0 && SetConsoleOutputCP(CP_UTF8)) {
        atexit(restore_console);
    }
    /* What main is given has only the characters of the machine's language. */
    int wide_count = 0;
    wchar_t **wide = CommandLineToArgvW(GetCommandLineW(), &wide_count);
    if (wide == NULL || wide_count <= 0) {
        return words;
    }
    char **made = calloc((size_t)wide_count + 1, sizeof *made);
    bool good = made != NULL;
    for (int k = 0; good && k < wide_count; k++) {
        made[k] = system_narrow(wide[k]);
        good = made[k] != NULL;
    }
    LocalFree(wide);
    if (!good) {
        system_words_free(made, words);
        return NULL;
    }
    *count = wide_count;
    return made;
}

void system_words_free(char **words, char **given) {
    if (words == NULL || words == given) {
        return;
    }
    for (char **word = words; *word != NULL; word++) {
        free(*word);
    }
    free(words);
}

bool system_is_device(const wchar_t *path) {
    return wcsncmp(path, L"\\\\.\\", 4) == 0;
}

wchar_t *system_wide_path(const char *path) {
    const int length = MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, path, -1, NULL, 0);
    wchar_t *given = length > 1 ? malloc((size_t)length * sizeof *given) : NULL;
    if (given == NULL) {
        errno = length > 1 ? ENOMEM : ENOENT;
        return NULL;
    }
    MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, path, -1, given, length);
    /* With room in front for what lifts the limit of 260 characters. */
    static const size_t room = 8;
    const DWORD size = GetFullPathNameW(given, 0, NULL, NULL);
    wchar_t *whole = size > 0 ? malloc((size + room) * sizeof *whole) : NULL;
    if (whole == NULL || GetFullPathNameW(given, size, whole + room, NULL) == 0) {
        errno = whole == NULL && size > 0 ? ENOMEM : ENOENT;
        free(whole);
        free(given);
        return NULL;
    }
    free(given);
    const wchar_t *full = whole + room;
    const wchar_t *prefix = L"\\\\?\\";
    if (full[0] == L'\\' && full[1] == L'\\') {
        if (full[2] == L'?' || full[2] == L'.') {
            prefix = L"";
        } else { /* \\server\share */
            prefix = L"\\\\?\\UNC";
            full++;
        }
    }
    const size_t before = wcslen(prefix);
    memcpy(whole, prefix, before * sizeof *whole);
    memmove(whole + before, full, (wcslen(full) + 1) * sizeof *whole);
    return whole;
}

FILE *system_open(const char *path, const char *mode) {
    wchar_t *wide = system_wide_path(path);
    if (wide == NULL) {
        return NULL;
    }
    wchar_t letters[8] = {0};
    for (size_t k = 0; mode[k] != '\0' && k + 1 < sizeof letters / sizeof *letters; k++) {
        letters[k] = (wchar_t)mode[k];
    }
    FILE *file = _wfopen(wide, letters);
    const int reason = errno;
    free(wide);
    errno = reason;
    return file;
}

bool system_is_folder(const char *path) {
    wchar_t *wide = system_wide_path(path);
    const DWORD attributes = wide != NULL ? GetFileAttributesW(wide) : INVALID_FILE_ATTRIBUTES;
    free(wide);
    return attributes != INVALID_FILE_ATTRIBUTES && (attributes & FILE_ATTRIBUTE_DIRECTORY) != 0;
}

void system_error_text(unsigned long number, char *text, size_t size) {
    wchar_t wide[256];
    DWORD length = FormatMessageW(FORMAT_MESSAGE_FROM_SYSTEM | FORMAT_MESSAGE_IGNORE_INSERTS, NULL, number, 0, wide,
                                  sizeof wide / sizeof *wide, NULL);
    while (length > 0 && wcschr(L"\r\n. ", wide[length - 1]) != NULL) {
        length--;
    }
    const int count = length > 0
        ? WideCharToMultiByte(CP_UTF8, 0, wide, (int)length, text, (int)size - 1, NULL, NULL)
        : snprintf(text, size, "error %lu of Windows", number);
    text[count > 0 && (size_t)count < size ? (size_t)count : 0] = '\0';
}

static BOOL WINAPI on_console_event(DWORD event) {
    on_stop(event == CTRL_C_EVENT ? 2 : event == CTRL_BREAK_EVENT ? 15 : 1);
    if (event != CTRL_C_EVENT && event != CTRL_BREAK_EVENT) {
        /* The console closes or the user logs off: once this returns the process is over, before main has tidied up. It is
           over after five seconds in any case. */
        Sleep(INFINITE);
    }
    return TRUE;
}

void system_on_stop(void (*stop)(int number)) {
    on_stop = stop;
    SetConsoleCtrlHandler(on_console_event, TRUE);
}

bool system_is_terminal(void) {
    DWORD mode;
    return GetConsoleMode((HANDLE)_get_osfhandle(_fileno(stdout)), &mode) != 0;
}

double system_seconds(void) {
    LARGE_INTEGER frequency, now;
    QueryPerformanceFrequency(&frequency);
    QueryPerformanceCounter(&now);
    return (double)now.QuadPart / (double)frequency.QuadPart;
}

uint64_t system_peak_memory(void) {
    PROCESS_MEMORY_COUNTERS counters;
    return K32GetProcessMemoryInfo(GetCurrentProcess(), &counters, sizeof counters) ? counters.PeakWorkingSetSize : 0;
}
#else
typedef int not_for_this_system;
#endif
