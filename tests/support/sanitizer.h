// Whether the tests, and with them all of the build, have a sanitizer: tests/sanitize.sh.
#pragma once

#if defined(__has_feature)  // Clang
#define REFLET_HAS_FEATURE(name) __has_feature(name)
#else
#define REFLET_HAS_FEATURE(name) 0
#endif

#if defined(__SANITIZE_ADDRESS__) || REFLET_HAS_FEATURE(address_sanitizer)
#include <sanitizer/lsan_interface.h>

namespace reflet::test {
constexpr bool addressSanitizer = true;
/// LeakSanitizer ignores what this thread allocates while one exists.
using UncheckedLeaks = __lsan::ScopedDisabler;
}  // namespace reflet::test
#else
namespace reflet::test {
constexpr bool addressSanitizer = false;
struct UncheckedLeaks {};
}  // namespace reflet::test
#endif

namespace reflet::test {

#if defined(__SANITIZE_THREAD__) || REFLET_HAS_FEATURE(thread_sanitizer)
constexpr bool threadSanitizer = true;
#else
constexpr bool threadSanitizer = false;
#endif

constexpr bool anySanitizer = addressSanitizer || threadSanitizer;
/// Factor of time limits: sanitizers make programs several times slower, ThreadSanitizer most.
constexpr int slowness = threadSanitizer ? 10 : addressSanitizer ? 5 : 1;

}  // namespace reflet::test

#undef REFLET_HAS_FEATURE
