# cmake -D OUTPUT=file.cpp -D FOLDER=dir -D FILES="a;b" -P EmbedShaders.cmake
# Writes shader files as the map builtInShaders() of render/gl/shader_library.h.
set(text "#include \"vlf/render/gl/shader_library.h\"\n\n")
string(APPEND text "const std::map<std::string, std::string>& vlf::gl::builtInShaders() {\n")
string(APPEND text "    static const std::map<std::string, std::string> kShaders{\n")
foreach(name ${FILES})
    file(READ ${FOLDER}/${name} source)
    string(APPEND text "        {\"${name}\", R\"glsl(${source})glsl\"},\n")
endforeach()
string(APPEND text "    };\n    return kShaders;\n}\n")
file(WRITE ${OUTPUT} "${text}")
