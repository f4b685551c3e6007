/* retarget: dresses an avatar in a garment that was modelled on another body. Knows the library by its header only. */
#include <signal.h>
#include <stdio.h>
#include <string.h>

#include "bespoke.h"
#include "diagnostics.h"
#include "follow.h"
#include "inputs.h"
#include "options.h"
#include "results.h"
#include "session.h"
#include "system.h"

/* The signal that asked to stop, and the session that it stops. */
static volatile sig_atomic_t stop_signal = 0;
static BespokeControl *volatile stop_control = NULL;

static void on_signal(int number) {
    stop_signal = number;
    if (stop_control != NULL) {
        bespoke_control_cancel(stop_control);
    }
}

/* All that is open during a run. */
typedef struct Run {
    Options options;
    Session session;
    Inputs inputs;
    Results results;
    /* Why the result is implausible; empty where it is not. */
    Message implausible;
    bool is_terminal;
    bool has_progress_line;
    int shown_stages;
} Run;

/* On a terminal one line that is written over and over, elsewhere one line for each stage once it has ended. */
static void show_progress(Run *run) {
    /* What goes on in the session, or goes on next. */
    static const char *const names[] = {"prepare", "inflate", "inflate", "fit", "verify", "done"};
    BespokeProgress progress = {.struct_size = sizeof progress};
    if (run->options.quiet || bespoke_session_read_progress(run->session.handle, &progress) != BESPOKE_STATUS_OK ||
        (progress.stage > BESPOKE_STAGE_DONE && progress.stage != BESPOKE_STAGE_REPOSE)) {
        return;
    }
    if (run->is_terminal) {
        const char *name = progress.stage == BESPOKE_STAGE_REPOSE ? "repose" : names[progress.stage];
        printf("\r%-8s t %.4f  iteration %-4u %7.1f s ", name, progress.t, (unsigned)progress.iteration,
               session_seconds(&run->session));
        run->has_progress_line = true;
    } else {
        const struct {
            const char *name;
            uint32_t next;
            double seconds;
        } stages[] = {
            {"prepare", BESPOKE_STAGE_PREPARED, progress.prepare_seconds},
            {"inflate", BESPOKE_STAGE_FIT, progress.inflate_seconds},
            {"fit", BESPOKE_STAGE_VERIFY, progress.fit_seconds},
            {"verify", BESPOKE_STAGE_DONE, progress.verify_seconds},
        };
        /* On the way back to its own pose inflate has ended, fit has not begun. */
        const uint32_t stage = progress.stage == BESPOKE_STAGE_REPOSE ? BESPOKE_STAGE_INFLATE : progress.stage;
        for (; run->shown_stages < 4 && stage >= stages[run->shown_stages].next; run->shown_stages++) {
            printf("%s: %.2f s\n", stages[run->shown_stages].name, stages[run->shown_stages].seconds);
        }
    }
    fflush(stdout);
}

static void end_progress_line(Run *run) {
    if (run->has_progress_line) {
        putchar('\n');
        fflush(stdout);
        run->has_progress_line = false;
    }
}

static bool work(Run *run) {
    show_progress(run);
    if (!session_good(&run->session, bespoke_session_prepare(run->session.handle), NULL)) {
        return false;
    }
    show_progress(run);
    for (uint32_t stage = BESPOKE_STAGE_PREPARED; stage != BESPOKE_STAGE_DONE; show_progress(run)) {
        const BespokeStatus status = bespoke_session_step(run->session.handle, 0, 100, &stage);
        if (session_good(&run->session, status, NULL)) {
            continue;
        }
        if (status != BESPOKE_STATUS_IMPLAUSIBLE_RESULT) {
            return false;
        }
        /* There is a result all the same. */
        run->implausible = run->session.message;
        run->session.status = BESPOKE_STATUS_OK;
    }
    /* To morphs of the avatar there is no answer where the result is not as designed. */
    return run->implausible.text[0] != '\0' || follow_solve(&run->session, &run->options);
}

/* From the files to the files. What went wrong is in the session. */
static bool dress(Run *run) {
    Session *session = &run->session;
    if (!inputs_set(&run->inputs, session, &run->options) || !work(run)) {
        return false;
    }
    end_progress_line(run);
    diagnostics_print(session->handle, run->options.quiet ? BESPOKE_SEVERITY_ERROR : BESPOKE_SEVERITY_WARNING, stderr);
    const bool is_good = run->implausible.text[0] == '\0';
    const BespokeStatus status = is_good ? BESPOKE_STATUS_OK : BESPOKE_STATUS_IMPLAUSIBLE_RESULT;
    if (!is_good) {
        fprintf(stderr, "retarget: %s\n", run->implausible.text);
    }
    return results_write(&run->results, session, &run->inputs, &run->options, bespoke_status_name(status),
                         run->implausible.text) &&
           stop_signal == 0 && results_commit(&run->results, &session->message);
}

/* Why there is no result, what the library has to say about it, and what is left. Returns the exit code. */
static int explain(Run *run) {
    Session *session = &run->session;
    end_progress_line(run);
    if (stop_signal != 0) {
        session->status = BESPOKE_STATUS_CANCELLED;
        fail(&session->message, "stopped by %s; there is no result", stop_signal == SIGINT ? "Ctrl-C" : "a signal");
    }
    fprintf(stderr, "retarget: %s\n", session->message.text);
    if (stop_signal == 0) {
        diagnostics_print(session->handle, run->options.quiet ? BESPOKE_SEVERITY_ERROR : BESPOKE_SEVERITY_NOTE, stderr);
    }
    results_write_failure(session, &run->inputs, &run->options, stderr);
    return stop_signal != 0 ? 128 + stop_signal : 1;
}

/* Opens the session and looks whether there is a place for the results: without these nothing can be done or left. */
static bool begin(Run *run) {
    Session *session = &run->session;
    if (!session_open(session) || !results_check(&run->options, &session->message)) {
        fprintf(stderr, "retarget: %s\n", session->message.text);
        return false;
    }
    stop_control = session->control;
    if (stop_signal != 0) {
        bespoke_control_cancel(session->control);
    }
    return true;
}

static int run_program(int count, char **words) {
    Run run;
    memset(&run, 0, sizeof run);
    run.is_terminal = system_is_terminal();
    Message message;
    if (!options_parse(&run.options, count, words, &message)) {
        options_free(&run.options);
        fprintf(stderr, "retarget: %s\n", message.text);
        return 2;
    }
    int code = 1;
    if (run.options.help) {
        options_print_usage(stdout);
        code = 0;
    } else if (run.options.version) {
        printf("retarget %s\n", bespoke_version_text());
        code = 0;
    } else {
        system_on_stop(on_signal);
        if (begin(&run)) {
            code = !dress(&run) ? explain(&run) : run.implausible.text[0] != '\0' ? 3 : 0;
        }
    }
    results_discard(&run.results);
    inputs_free(&run.inputs);
    stop_control = NULL;
    session_close(&run.session);
    options_free(&run.options);
    return code;
}

int main(int count, char **given) {
    char **words = system_words(&count, given);
    if (words == NULL) {
        fputs("retarget: the command line does not fit into memory\n", stderr);
        return 1;
    }
    const int code = run_program(count, words);
    system_words_free(words, given);
    return code;
}
