#include "vlf/io/checkpoint_file.h"

#include "vlf/io/records.h"

#include <algorithm>

namespace vlf {

namespace {

/// Checkpoints are written often and read seldom.
constexpr int kCompressionLevel = 1;

const std::string* valueOf(const CheckpointIdentity& identity, const std::string& name) {
    const auto found = std::find_if(identity.begin(), identity.end(),
                                    [&](const CheckpointTrait& t) { return t.name == name; });
    return found == identity.end() ? nullptr : &found->value;
}

void add(std::string& list, const std::string& text) {
    list += (list.empty() ? "" : "; ") + text;
}

std::string differences(const CheckpointIdentity& kept, const CheckpointIdentity& wanted) {
    std::string list;
    for (const CheckpointTrait& t : wanted) {
        const std::string* const value = valueOf(kept, t.name);
        if (!value)
            add(list, t.name + " is missing");
        else if (*value != t.value)
            add(list, t.name + " was " + *value + ", is " + t.value);
    }
    for (const CheckpointTrait& t : kept)
        if (!valueOf(wanted, t.name)) add(list, t.name + " was " + t.value);
    return list;
}

}  // namespace

template <class S>
void describe(S& s, Field<S, CheckpointTrait> t) {
    s(t.name, t.value);
}

CheckpointWriter::CheckpointWriter(const std::string& path, const CheckpointIdentity& identity)
    : output_(path), file_(output_, kCompressionLevel) {
    addRecord(file_, kIdentityChunk, identity);
}

void CheckpointWriter::commit() {
    file_.finish();
    output_.commit();
}

CheckpointReader::CheckpointReader(const std::string& path) : file_(path) {
    if (!file_.has(kIdentityChunk))
        throw InputError(SourceLocation{path, 0, ""}, "is no checkpoint");
}

void CheckpointReader::require(const CheckpointIdentity& identity) const {
    CheckpointIdentity kept;
    readRecord(file_, kIdentityChunk, kept);
    const std::string list = differences(kept, identity);
    if (!list.empty())
        throw InputError(SourceLocation{file_.path(), 0, ""}, "is of another bake: " + list);
}

}  // namespace vlf
