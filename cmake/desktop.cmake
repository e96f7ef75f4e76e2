# What the program brings along for people: manual page and completion, which it prints itself, and what a desktop shows.
set(printed ${CMAKE_CURRENT_BINARY_DIR}/printed)
file(MAKE_DIRECTORY ${printed})
find_program(GZIP gzip REQUIRED)
set(run ${CMAKE_COMMAND} -E env ASAN_OPTIONS=detect_leaks=0 $<TARGET_FILE:reflet_program>)
add_custom_command(OUTPUT ${printed}/reflet.1.gz ${printed}/reflet.bash ${printed}/_reflet ${printed}/reflet.fish
    COMMAND ${run} man > ${printed}/reflet.1
    COMMAND ${GZIP} -9nf ${printed}/reflet.1
    COMMAND ${run} completion bash > ${printed}/reflet.bash
    COMMAND ${run} completion zsh > ${printed}/_reflet
    COMMAND ${run} completion fish > ${printed}/reflet.fish
    DEPENDS reflet_program COMMENT "Manual page and completion" VERBATIM)
add_custom_target(reflet_printed ALL DEPENDS ${printed}/reflet.1.gz)

set(share ${CMAKE_INSTALL_DATADIR})
install(FILES ${printed}/reflet.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
install(FILES ${printed}/reflet.bash DESTINATION ${share}/bash-completion/completions RENAME reflet COMPONENT program)
install(FILES ${printed}/_reflet DESTINATION ${share}/zsh/vendor-completions COMPONENT program)
install(FILES ${printed}/reflet.fish DESTINATION ${share}/fish/vendor_completions.d COMPONENT program)

if(TARGET PkgConfig::IMGUI AND TARGET PkgConfig::GLFW) # the window
    set(id org.reflet.Reflet)
    install(FILES packaging/${id}.desktop DESTINATION ${share}/applications COMPONENT program)
    install(FILES packaging/${id}.svg DESTINATION ${share}/icons/hicolor/scalable/apps COMPONENT program)
    configure_file(packaging/${id}.metainfo.xml.in ${CMAKE_CURRENT_BINARY_DIR}/${id}.metainfo.xml @ONLY)
    install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${id}.metainfo.xml DESTINATION ${share}/metainfo COMPONENT program)
endif()
