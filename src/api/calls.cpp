// Errors of the C API.
#include "api/calls.h"

#include "base/message.h"
#include "gpu/vulkan.h"

namespace reflet::api {

std::string& lastError() {
    thread_local std::string text;
    return text;
}

RefletResult handleException() {
    const auto note = [](RefletResult result, const char* text) {
        try {
            lastError() = oneLine(text, longestMessage);
        } catch (...) {
            lastError().clear();
        }
        return result;
    };
    try {
        throw;
    } catch (const Failure& failure) {
        return note(failure.result(), failure.what());
    } catch (const UsageError& error) {
        return note(REFLET_ERROR_INVALID_ARGUMENT, error.what());
    } catch (const gpu::OutOfMemory& error) {
        return note(REFLET_ERROR_OUT_OF_MEMORY, error.what());
    } catch (const gpu::Unsupported& error) {
        return note(REFLET_ERROR_MISSING_FEATURE, error.what());
    } catch (const Error& error) {
        return note(REFLET_ERROR_VULKAN, error.what());
    } catch (const std::bad_alloc&) {
        return note(REFLET_ERROR_OUT_OF_MEMORY, "out of host memory");
    } catch (const std::exception& error) {
        return note(REFLET_ERROR_INTERNAL, error.what());
    } catch (...) {
        return note(REFLET_ERROR_INTERNAL, "unknown");
    }
}

}  // namespace reflet::api

using namespace reflet::api;

uint32_t refletVersion(void) {
    return REFLET_VERSION;
}

const char* refletResultName(RefletResult result) {
    switch (result) {
        case REFLET_SUCCESS:
            return "REFLET_SUCCESS";
        case REFLET_ERROR_INVALID_ARGUMENT:
            return "REFLET_ERROR_INVALID_ARGUMENT";
        case REFLET_ERROR_INCOMPATIBLE_VERSION:
            return "REFLET_ERROR_INCOMPATIBLE_VERSION";
        case REFLET_ERROR_MISSING_FEATURE:
            return "REFLET_ERROR_MISSING_FEATURE";
        case REFLET_ERROR_OUT_OF_MEMORY:
            return "REFLET_ERROR_OUT_OF_MEMORY";
        case REFLET_ERROR_VULKAN:
            return "REFLET_ERROR_VULKAN";
        case REFLET_ERROR_INTERNAL:
            return "REFLET_ERROR_INTERNAL";
    }
    return "unknown";
}

const char* refletLastError(void) {
    return lastError().c_str();
}
