// Reports failed invariants.
#include "base/error.h"

namespace reflet {

void checkFailed(const char* condition, const char* file, int line, const std::string& detail) {
    throw std::logic_error(fmt::format("internal error at {}:{}: {} does not hold: {}", file, line, condition, detail));
}

}  // namespace reflet
