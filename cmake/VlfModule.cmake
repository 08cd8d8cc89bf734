# vlf_module(NAME SOURCES files... [PUBLIC modules and libraries...] [PRIVATE libraries...])
# One module of src/vlf is one static library vlf::NAME. PUBLIC lists exactly the modules it may
# include; tests/unit/architecture_test holds the same list against the #include lines.
function(vlf_module NAME)
    cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
    set(target vlf_${NAME})
    add_library(${target} STATIC ${ARG_SOURCES})
    add_library(vlf::${NAME} ALIAS ${target})
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${NAME} POSITION_INDEPENDENT_CODE ON)
    target_include_directories(${target} PUBLIC
        $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
        $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
    target_compile_features(${target} PUBLIC cxx_std_20)
    target_link_libraries(${target} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
    vlf_compile_options(${target})
    set_property(GLOBAL APPEND PROPERTY VLF_MODULES ${target})
endfunction()

function(vlf_compile_options target)
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wpedantic
        $<$<BOOL:${VLF_WARNINGS_AS_ERRORS}>:-Werror>)
    if(VLF_SANITIZE)
        target_compile_options(${target} PUBLIC -fsanitize=${VLF_SANITIZE} -fno-omit-frame-pointer)
        target_link_options(${target} PUBLIC -fsanitize=${VLF_SANITIZE})
    endif()
    if(VLF_SANITIZE MATCHES "undefined")
        target_compile_options(${target} PUBLIC -fno-sanitize-recover=undefined)
    endif()
    if(VLF_SANITIZE MATCHES "thread")
        target_compile_definitions(${target} PUBLIC VLF_STD_THREADS=1)
    endif()
endfunction()
