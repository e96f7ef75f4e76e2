// What the program does where nothing else can: standard streams that are closed, signals that would end it in the
// middle of its work, crashes of libraries and drivers.
#pragma once

namespace reflet {

constexpr int exitFailed = 1;  ///< exit status of everything but wrong use

/// To be called first of all. From then on:
/// - Standard input, output and error are open (/dev/null if the caller closed them): a picture's file never becomes
///   standard error.
/// - A closed pipe and a file beyond `ulimit -f` are errors of writing, not signals. CPU time beyond `ulimit -t`
///   is a failure.
/// - An exception that nothing catches, an abort or a crash prints one line, removes temporary files and exits with
///   status 1. Exceptions: where core dumps are enabled (`ulimit -c`) and in builds with AddressSanitizer, which report
///   them better, crashes stay what they are.
void prepareForFailures() noexcept;

}  // namespace reflet
