#pragma once

#include <cstdio>
#include <string>

namespace endoflow {

/// Sees to it that standard input, output and error are open: a file opened in place of a closed one would get what is
/// printed. Where one was closed, printing fails as it would have.
void hold_standard_streams();

/// Writes to a stream at once. What cannot be written is lost, for a run does not end because nobody listens; the
/// stream remembers it (std::ferror).
void say(std::FILE* stream, const std::string& text);

/// The text cut to so many columns of a terminal, each a UTF-8 character; whole when `columns` is 0.
[[nodiscard]] std::string clipped(const std::string& text, int columns);

/// Columns of the terminal behind a stream, 0 when they are unknown.
[[nodiscard]] int terminal_columns(std::FILE* stream);

}  // namespace endoflow
