// The messages of errors.
#pragma once

#include "base/error.h"

#include <functional>
#include <string>

namespace reflet::test {

/// "no error" if it throws none.
inline std::string messageOf(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace reflet::test
