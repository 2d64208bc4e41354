/* Tables on a terminal: for people, and no wider or longer than they look at. */
#ifndef PS_CLI_TERMINAL_H
#define PS_CLI_TERMINAL_H

#include "cli/command.h"

/* Where a table goes to a terminal: its view, and text as the format where none was said. */
void ps_terminal_settle(const ps_command *command, ps_request *arguments);

#endif
