/* Signals: what asks the program to end ends it within a second, wherever it is.
 *
 * SIGINT, SIGTERM and SIGHUP first set ps_interrupted, which long work looks at, so that the
 * command itself gives everything up and says how far it was. Where it does not within 0.7 s,
 * because it is inside a driver that compiles, say, a timer ends the process: temporary files are
 * removed, children ended, and the sentence and the exit code are the same.
 */
#ifndef PS_CLI_SIGNALS_H
#define PS_CLI_SIGNALS_H

#include <signal.h>
#include <stdbool.h>

/* Set by the handlers, and read by whoever works. */
extern volatile sig_atomic_t ps_interrupted;

void ps_signals_prepare(void);

/* From now on the process ends with this exit code and says nothing, should its end take long. */
void ps_signals_end(int exit_code);

/* Has somebody closed the other end of a pipe that was written to? */
bool ps_signals_pipe_closed(void);

#endif
