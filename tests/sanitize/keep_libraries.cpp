// Linked into every program that has a sanitizer: libraries stay loaded, as a report can only name, and a suppression
// only match, those that are. Vulkan's loader would close its driver before LeakSanitizer looks.
extern "C" {
__attribute__((visibility("default"))) int dlclose(void* library);
int dlclose(void* /*library*/) {
    return 0;
}
}
