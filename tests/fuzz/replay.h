// Calls fuzz targets with their seeds and with damaged ones, so that plain test programs notice when a target or a
// reader breaks. A finding ends the program.
#pragma once

#include "gltf_mutator.h"
#include "seeds.h"
#include "targets.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace reflet::fuzz {

/// By the name that seeds have.
using Targets = std::map<std::string, Target*>;

inline void call(Target* target, const std::string& bytes) {
    target(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
}

/// One byte changed, or one value where the bytes have a JSON document.
inline std::string damaged(const std::string& bytes, std::mt19937& random) {
    if (auto parts = gltfParts(bytes); parts && random() % 4 != 0) {
        mutateDocument(parts->document, random);
        return gltfFile(*parts);
    }
    std::string result = bytes;
    result.at(random() % result.size()) = static_cast<char>(random() % 256);
    return result;
}

/// Each target must have a seed.
inline void replay(const Targets& targets, const std::vector<Seed>& seeds, int damagedOfEach) {
    std::mt19937 random(7);
    std::set<std::string> called;
    for (const Seed& seed : seeds) {
        const auto target = targets.find(seed.target);
        ASSERT_NE(target, targets.end()) << seed.target;
        called.insert(seed.target);
        call(target->second, seed.bytes);
        for (int i = 0; i < damagedOfEach; ++i) {
            call(target->second, damaged(seed.bytes, random));
        }
    }
    EXPECT_EQ(called.size(), targets.size());
}

}  // namespace reflet::fuzz
