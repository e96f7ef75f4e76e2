// Runs the target of the C API on random bytes: api_sequences COUNT [SEED]. Without libFuzzer's counters it is several
// times as fast, for millions of sequences. At a finding, what it read is in api-sequence.bin of this folder, and
// api_sequences FILE repeats it.
#include "api_machine.h"
#include "seeds.h"
#include "targets.h"

#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>

using namespace reflet;

extern "C" {
const char* __asan_default_options();   // NOLINT: the sanitizer's name
const char* __ubsan_default_options();  // NOLINT: the sanitizer's name

// Short stacks: they take most of the time otherwise.
const char* __asan_default_options() {  // NOLINT: the sanitizer's name
    return "abort_on_error=1:malloc_context_size=3:quarantine_size_mb=8";
}
const char* __ubsan_default_options() {  // NOLINT: the sanitizer's name
    return "abort_on_error=1:print_stacktrace=1";
}
}

namespace {

std::string current;

void keepCurrent(int /*signal*/) {
    const int file = ::open("api-sequence.bin", O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    (void)!::write(file, current.data(), current.size());
    ::_exit(1);
}

// A seed with some bytes changed, or nothing but random bytes.
std::string sequence(const std::vector<fuzz::Seed>& seeds, std::mt19937& random) {
    constexpr size_t longest = 100;
    std::string bytes(random() % longest, '\0');
    if (random() % 4 == 0) {
        bytes = seeds[random() % seeds.size()].bytes.substr(0, longest);
    }
    const uint32_t share = random() % 3 == 0 ? 64 : 4 + random() % 40;  // of 64 bytes
    for (char& byte : bytes) {
        byte = random() % 64 < share ? static_cast<char>(random() % 256) : byte;
    }
    return bytes;
}

void call(std::string bytes) {
    current = std::move(bytes);
    fuzz::api(reinterpret_cast<const uint8_t*>(current.data()), current.size());
}

}  // namespace

int main(int argc, char** argv) {
    std::signal(SIGABRT, keepCurrent);
    const char* const what = argc > 1 ? argv[1] : "1000";
    if (std::ifstream file(what, std::ios::binary); file) {
        call({std::istreambuf_iterator<char>(file), {}});
        return 0;
    }
    const uint64_t count = std::strtoull(what, nullptr, 10);
    std::mt19937 random(argc > 2 ? static_cast<uint32_t>(std::strtoul(argv[2], nullptr, 10)) : 1);
    const std::vector<fuzz::Seed> seeds = fuzz::apiSeeds();
    for (uint64_t i = 0; i < count; ++i) {
        call(sequence(seeds, random));
        if (i % 100000 == 99999) {
            std::fprintf(stderr, "%llu\n", static_cast<unsigned long long>(i + 1));
        }
    }
    fuzz::printApiCounts();
    return 0;
}
