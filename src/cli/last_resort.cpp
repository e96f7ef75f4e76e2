// What the program does where nothing else can.
#include "cli/last_resort.h"

#include "base/file.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <exception>
#include <new>
#include <string_view>

namespace reflet {

namespace {

// Only calls that a signal handler may make.
[[noreturn]] void endNow(std::string_view message) noexcept {
    removeTemporaryFiles();
    if (::write(STDERR_FILENO, message.data(), message.size()) < 0) {
        ::_exit(exitFailed);  // nothing is left to tell it to
    }
    ::_exit(exitFailed);
}

[[noreturn]] void endTerminated() noexcept {
    try {
        if (const std::exception_ptr thrown = std::current_exception()) {
            std::rethrow_exception(thrown);
        }
    } catch (const std::bad_alloc&) {
        endNow("reflet: needs more memory than is available\n");
    } catch (...) {  // its text may need memory
        endNow("reflet: internal error: an exception that nothing caught\n");
    }
    endNow("reflet: internal error: the program ended itself\n");
}

bool isLimited(__rlimit_resource resource, rlim_t enough = RLIM_INFINITY) noexcept {
    rlimit limit{};
    return ::getrlimit(resource, &limit) == 0 && limit.rlim_cur < enough;
}

void endCrashed(int /*signal*/) {
    constexpr rlim_t usualStack = 8U << 20U;
    if (isLimited(RLIMIT_STACK, usualStack)) {
        endNow("reflet: crashed, probably for lack of memory for the stack: raise ulimit -s\n");
    }
    if (isLimited(RLIMIT_AS) || isLimited(RLIMIT_DATA)) {  // Mesa and LLVM do not check what they allocate
        endNow(
            "reflet: a library or the graphics driver crashed, probably for lack of memory: raise ulimit -v or -d\n");
    }
    endNow("reflet: internal error: the program, a library or the graphics driver crashed\n");
}

void endOutOfTime(int /*signal*/) {
    endNow("reflet: took more CPU time than ulimit -t allows\n");
}

// `ulimit -t` sets both limits, and the second one kills without a signal that could be handled.
void leaveTimeToEnd() {
    rlimit time{};
    if (::getrlimit(RLIMIT_CPU, &time) == 0 && time.rlim_cur != RLIM_INFINITY && time.rlim_cur == time.rlim_max &&
        time.rlim_cur > 1) {
        --time.rlim_cur;
        ::setrlimit(RLIMIT_CPU, &time);
    }
}

bool crashesAreWanted() {
#if defined(__SANITIZE_ADDRESS__)
    return true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
    return true;
#endif
#endif
    rlimit cores{};
    return ::getrlimit(RLIMIT_CORE, &cores) != 0 || cores.rlim_cur > 0;
}

void catchCrashes() {
    // A stack of its own: the other one may be what has overflowed.
    static std::array<char, 65536> stack;
    stack_t ours{};
    ours.ss_sp = stack.data();
    ours.ss_size = stack.size();
    ::sigaltstack(&ours, nullptr);
    for (const int signal : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT}) {
        struct sigaction action {};
        action.sa_handler = endCrashed;
        action.sa_flags = SA_ONSTACK | static_cast<int>(SA_RESETHAND);
        ::sigaction(signal, &action, nullptr);
    }
}

void openStandardStreams() {
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(descriptor, F_GETFD) < 0) {
            // The lowest free number: this one, as those below are open.
            (void)::open("/dev/null", descriptor == STDIN_FILENO ? O_RDONLY : O_WRONLY);
        }
    }
}

}  // namespace

void prepareForFailures() noexcept {
    openStandardStreams();
    ::signal(SIGPIPE, SIG_IGN);
    ::signal(SIGXFSZ, SIG_IGN);
    ::signal(SIGXCPU, endOutOfTime);
    leaveTimeToEnd();
    std::set_terminate(endTerminated);
    if (!crashesAreWanted()) {
        catchCrashes();
    }
}

}  // namespace reflet
