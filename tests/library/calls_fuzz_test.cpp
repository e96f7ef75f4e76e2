// The fuzz target of the C API, on its seeds and on damaged ones; and that it reaches what it is for.
#include "fuzz/api_machine.h"
#include "fuzz/seeds.h"
#include "fuzz/targets.h"

#include <gtest/gtest.h>

#include <random>

namespace reflet::test::calls_fuzz_test {
namespace {

void call(const std::string& bytes) {
    fuzz::api(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
}

TEST(FuzzTargets, OfTheLibrarysCallsSurvivesItsSeedsAndDamagedOnes) {
    constexpr int damagedOfEach = 16;
    std::mt19937 random(7);
    for (const fuzz::Seed& seed : fuzz::apiSeeds()) {
        ASSERT_EQ(seed.target, "api");
        call(seed.bytes);
        for (int i = 0; i < damagedOfEach; ++i) {
            std::string bytes = seed.bytes;
            for (uint32_t left = 1 + random() % 8; left > 0; --left) {
                bytes[random() % bytes.size()] = static_cast<char>(random() % 256);
            }
            call(bytes);
        }
    }
    // Each function both does its work and refuses something, but those that return nothing.
    const fuzz::ApiCounts& counts = fuzz::apiCounts();
    for (size_t i = 0; i < fuzz::apiCalls; ++i) {
        const std::string name = fuzz::apiCallName(i);
        EXPECT_GE(counts.accepted.at(i), 1U) << name;
        EXPECT_GE(counts.refused.at(i), name.starts_with("refletDestroy") ? 0U : 1U) << name;
        RecordProperty(name, std::to_string(counts.accepted.at(i)) + " " + std::to_string(counts.refused.at(i)));
    }
}

}  // namespace
}  // namespace reflet::test::calls_fuzz_test
