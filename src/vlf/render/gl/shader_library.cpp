#include "vlf/render/gl/shader_library.h"

#include "vlf/base/error.h"
#include "vlf/base/file.h"

#include <filesystem>
#include <sstream>

namespace vlf::gl {

namespace {

template <class Query, class GetLog>
std::string logOf(GLuint id, Query query, GetLog getLog) {
    GLint length = 0;
    query(id, GL_INFO_LOG_LENGTH, &length);
    std::string text(static_cast<std::size_t>(std::max(length, 1)), '\0');
    getLog(id, length, nullptr, text.data());
    return text;
}

}  // namespace

std::string ShaderLibrary::source(const std::string& file) const {
    if (const std::string path = folder_ + "/" + file;
        !folder_.empty() && std::filesystem::exists(path)) {
        const auto bytes = readFile(path);
        return {bytes.begin(), bytes.end()};
    }
    const auto found = builtInShaders().find(file);
    if (found == builtInShaders().end()) throw InputError("no shader file " + file);
    return found->second;
}

/// The text with its includes in place, each file once.
std::string ShaderLibrary::expand(const std::string& file, const Defines& defines,
                                  std::vector<std::string>& files) const {
    for (const std::string& seen : files)
        if (seen == file) return {};
    const std::size_t number = files.size();
    files.push_back(file);
    std::istringstream stream(source(file));
    std::string text = "#line 1 " + std::to_string(number) + "\n";
    int lineNumber = 0;
    for (std::string line; std::getline(stream, line);) {
        ++lineNumber;
        if (line.rfind("#include ", 0) != 0) {
            text += line + "\n";
            continue;
        }
        std::string name = line.substr(9);
        if (const Define* define = defines.find(name)) name = define->value();
        if (name.size() > 2 && name.front() == '"') name = name.substr(1, name.size() - 2);
        // What C++ alone includes, and names that this variant does not define, lie in branches
        // that the preprocessor leaves out.
        if (!name.starts_with("vlf/") && !name.starts_with("<") && name.find('.') != name.npos)
            text += expand(name, defines, files);
        text += "#line " + std::to_string(lineNumber + 1) + " " + std::to_string(number) + "\n";
    }
    return text;
}

Shader ShaderLibrary::shader(GLenum stage, const std::string& file, const Defines& defines) const {
    std::string text = "#version 450 core\n";
    for (const Defines* all : {&common_, &defines})
        for (const Define& d : *all)
            text += "#define " + std::string(d.name) + " " + d.value() + "\n";
    std::vector<std::string> files;
    text += expand(file, defines, files);
    Shader shader(glCreateShader(stage));
    const char* source = text.c_str();
    glShaderSource(shader.id(), 1, &source, nullptr);
    glCompileShader(shader.id());
    GLint ok = 0;
    glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &ok);
    if (ok) return shader;
    std::string message = "shader " + file + " does not compile";
    for (std::size_t i = 0; i < files.size(); ++i)
        message += (i == 0 ? " (0: " : ", " + std::to_string(i) + ": ") + files[i];
    throw InputError(message + "): " + logOf(shader.id(), glGetShaderiv, glGetShaderInfoLog));
}

GLuint ShaderLibrary::program(const std::string& name, const Defines& defines) {
    const Key key(name, defines);
    auto found = programs_.find(key);
    if (found == programs_.end()) found = programs_.emplace(key, make(key)).first;
    return found->second.id();
}

void ShaderLibrary::reload() {
    std::map<Key, Program> made;
    for (const auto& [key, old] : programs_) made.emplace(key, make(key));
    programs_ = std::move(made);
}

Program ShaderLibrary::make(const Key& key) const {
    const auto& [name, defines] = key;
    const Shader vertex = shader(GL_VERTEX_SHADER, name + ".vert", defines);
    const Shader fragment = shader(GL_FRAGMENT_SHADER, name + ".frag", defines);
    Program program(glCreateProgram());
    glAttachShader(program.id(), vertex.id());
    glAttachShader(program.id(), fragment.id());
    glLinkProgram(program.id());
    GLint ok = 0;
    glGetProgramiv(program.id(), GL_LINK_STATUS, &ok);
    if (!ok)
        throw InputError("shaders " + name + " do not link: " +
                         logOf(program.id(), glGetProgramiv, glGetProgramInfoLog));
    return program;
}

}  // namespace vlf::gl
