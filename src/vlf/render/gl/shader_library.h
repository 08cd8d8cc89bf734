#pragma once
// Programs from shader files: built in, or from a folder that overrides them.

#include "vlf/render/gl/defines.h"
#include "vlf/render/gl/gl_object.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace vlf::gl {

class ShaderLibrary {
  public:
    /// Files in `folder` are used in place of the built-in ones of the same name; empty: none.
    explicit ShaderLibrary(std::string folder = {}) : folder_(std::move(folder)) {}

    /// In all programs that are made from now on, besides their own.
    void setCommon(const Defines& defines) { common_ = defines; }

    /// The program of NAME.vert and NAME.frag, made when first asked for. Throws InputError with
    /// the driver's message, in which lines are named by file.
    GLuint program(const std::string& name, const Defines& defines);

    /// Makes all programs anew, from what the folder holds now; throws as program(), and all are
    /// then as before.
    void reload();

  private:
    using Key = std::pair<std::string, Defines>;

    Program make(const Key& key) const;
    Shader shader(GLenum stage, const std::string& file, const Defines& defines) const;
    std::string source(const std::string& file) const;
    std::string expand(const std::string& file, const Defines& defines,
                       std::vector<std::string>& files) const;

    std::string folder_;
    Defines common_;
    std::map<Key, Program> programs_;
};

/// Built-in shader files by name.
const std::map<std::string, std::string>& builtInShaders();

}  // namespace vlf::gl
