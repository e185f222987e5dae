// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
#include "lio/io/options_yaml.hpp"

#include <algorithm>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <set>

#include "io/nearest_name.hpp"
#include "io/yaml_documents.hpp"
#include "lio/io/beam_table.hpp"
#include "lio/io/printable.hpp"
#include "lio/pipeline/options_fields.hpp"
#include "yaml_rotations.hpp"
#include "yaml_values.hpp"

namespace lio {
namespace {

constexpr const char* kRotationKey = "rotation_wxyz";

std::string Join(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

struct KnownKey {
  std::function<std::string(const YAML::Node&)> parse;  // null for a group of keys
  std::vector<std::string> sets;  // the paths of the fields that it sets, usually its own
};

struct OptionalGroup {
  std::string path;
  std::vector<std::string> fields;  // paths
  std::function<void()> disengage;
};

bool HasDefault(const std::string& path) {
  const std::string_view key = std::string_view(path).substr(path.rfind('.') + 1);
  return std::ranges::find(kExtrinsicStdKeys, key) != std::end(kExtrinsicStdKeys);
}

// Knows every key of an Options by dotted path, with how to set it. All optional groups are
// engaged.
class KeyTable {
 public:
  explicit KeyTable(Options& options) { VisitFields(*this, options); }

  template <class T>
  void operator()(const char* key, T& field, const char* /*meaning*/, Range = {}) {
    const std::string outer = path_;
    path_ = Join(path_, key);
    Add(field);
    path_ = outer;
  }

  const KnownKey* Find(const std::string& path) const {
    const auto found = keys_.find(path);
    return found == keys_.end() ? nullptr : &found->second;
  }
  const OptionalGroup* FindOptional(const std::string& path) const {
    for (const OptionalGroup& group : optional_groups) {
      if (group.path == path) return &group;
    }
    return nullptr;
  }
  std::string Nearest(const std::string& path) const {
    std::vector<std::string> names;
    for (const auto& [name, key] : keys_) names.push_back(name);
    return NearestName(path, names);
  }

  std::vector<OptionalGroup> optional_groups;

 private:
  template <class T>
  void Add(T& field) {
    if constexpr (kIsGroup<T>) {
      keys_[path_] = {};
      VisitFields(*this, field);
      if constexpr (std::derived_from<T, Pose>) AddOtherForms(field);
    } else {
      keys_[path_] = {[&field](const YAML::Node& node) { return ParseValue(node, field); },
                      {path_}};
      if (!optional_groups.empty() && path_.starts_with(optional_groups.back().path + ".") &&
          !HasDefault(path_)) {
        optional_groups.back().fields.push_back(path_);
      }
    }
  }
  template <class T>
  void Add(std::optional<T>& field) {
    optional_groups.push_back({path_, {}, [&field] { field.reset(); }});
    Add(field.emplace());
  }
  // A pose's rotation, or all of it, may be given in other forms than those that are printed.
  void AddOtherForms(Pose& pose) {
    const std::string rotation = Join(path_, kRotationKey);
    keys_[Join(path_, "rotation_rpy_deg")] = {
        [&pose](const YAML::Node& node) { return ParseRpyDeg(node, pose.rotation); }, {rotation}};
    keys_[Join(path_, "rotation_matrix")] = {
        [&pose](const YAML::Node& node) { return ParseRotationMatrix(node, pose.rotation); },
        {rotation}};
    keys_[Join(path_, "matrix")] = {
        [&pose](const YAML::Node& node) { return ParseTransformMatrix(node, pose); },
        {Join(path_, "translation_m"), rotation}};
  }

  std::map<std::string, KnownKey> keys_;
  std::string path_;
};

class Loader {
 public:
  void ApplyFile(const std::filesystem::path& file);
  void ApplySet(const std::string& set);
  LoadResult Finish();

 private:
  void ApplyMap(const YAML::Node& map, const std::string& path);
  void ApplyKey(const YAML::Node& key, const YAML::Node& value, const std::string& path);
  void CheckGivenOnce(const YAML::Node& map, const std::string& path);
  void SettleOptionalGroups();

  std::string LineOf(const YAML::Mark& mark) const {
    return is_set_ ? source_ : source_ + ":" + std::to_string(mark.line + 1);
  }
  std::string Where(const YAML::Node& node) const { return LineOf(node.Mark()); }
  void Fault(const std::string& where, const std::string& what) {
    constexpr std::size_t kMaxBytes = 400;  // keys may be long, too
    result_.faults.push_back(where + ": " + Excerpt(what, kMaxBytes));
  }

  LoadResult result_;
  KeyTable keys_{result_.options};
  std::map<std::string, std::string> given_;  // the source of each given key's value, by path
  std::string source_;                        // the file, or "--set"
  bool is_set_ = false;
  bool is_file_unusable_ = false;
  std::set<std::string> refused_;  // keys that are missing, or whose last value could not be read
};

void Loader::ApplyFile(const std::filesystem::path& file) {
  source_ = file.string();
  is_set_ = false;
  std::ifstream stream(file);
  if (!stream || std::filesystem::is_directory(file)) {
    Fault(source_, "cannot be read; give an existing YAML file");
    is_file_unusable_ = true;
    return;
  }
  try {
    const YamlDocument document = LoadYamlDocument({std::istreambuf_iterator<char>(stream), {}});
    if (document.second_at) Fault(LineOf(*document.second_at), "holds a second YAML document");
    ApplyMap(document.first, "");
  } catch (const YAML::Exception& e) {
    Fault(LineOf(e.mark), "is not valid YAML: " + e.msg);
    is_file_unusable_ = true;
  }
}

void Loader::ApplySet(const std::string& set) {
  source_ = "--set " + Excerpt(set);
  is_set_ = true;
  const std::size_t equals = set.find('=');
  if (equals == std::string::npos || equals == 0) {
    Fault(source_, "expects KEY=VALUE, e.g. ndt.voxel_m=1.5");
    return;
  }
  try {
    ApplyKey(YAML::Node(set.substr(0, equals)), YAML::Load(set.substr(equals + 1)), "");
  } catch (const YAML::Exception& e) {
    Fault(source_, "VALUE is not valid YAML: " + e.msg);
  }
}

void Loader::ApplyMap(const YAML::Node& map, const std::string& path) {
  if (map.IsNull()) return;
  if (!map.IsMap()) {
    Fault(Where(map), (path.empty() ? "" : path + ": ") + "expects keys, not " + Describe(map));
    is_file_unusable_ = is_file_unusable_ || path.empty();
    return;
  }
  std::map<std::string, int> seen;
  for (const auto& pair : map) {
    if (pair.first.IsScalar() && seen[pair.first.Scalar()]++ > 0) {
      Fault(Where(pair.first), Join(path, pair.first.Scalar()) + ": is given twice");
    }
    ApplyKey(pair.first, pair.second, path);
  }
  CheckGivenOnce(map, path);
}

// Refuses two forms of one thing in one map: which of them counts would depend on their order.
void Loader::CheckGivenOnce(const YAML::Node& map, const std::string& path) {
  std::map<std::string, std::string> setters;  // the key that sets it, by the field's path
  for (const auto& pair : map) {
    if (!pair.first.IsScalar()) continue;
    const std::string full = Join(path, pair.first.Scalar());
    const KnownKey* key = keys_.Find(full);
    if (key == nullptr) continue;
    for (const std::string& field : key->sets) {
      const auto [earlier, is_new] = setters.emplace(field, full);
      if (is_new || earlier->second == full) continue;
      Fault(Where(pair.first), full + ": " + earlier->second + " gives this already; keep one");
      break;
    }
  }
}

void Loader::ApplyKey(const YAML::Node& key, const YAML::Node& value, const std::string& path) {
  if (!key.IsScalar()) {
    Fault(Where(key), "a key must be a name, not " + Describe(key));
    return;
  }
  const std::string full = Join(path, key.Scalar());
  const KnownKey* known = keys_.Find(full);
  if (known == nullptr) {
    Fault(Where(key), full + ": unknown key; did you mean " + keys_.Nearest(full) + "?");
    return;
  }
  const OptionalGroup* optional = keys_.FindOptional(full);
  if (optional != nullptr && value.IsNull()) {
    for (const std::string& field : optional->fields) given_.erase(field);
    return;
  }
  given_[full] = Where(key);
  for (const std::string& field : known->sets) given_[field] = Where(key);
  if (!known->parse) {
    ApplyMap(value, full);
    return;
  }
  const std::string problem = known->parse(value);
  for (const std::string& field : known->sets) {
    if (problem.empty()) {
      refused_.erase(field);
    } else {
      refused_.insert(field);
    }
  }
  if (!problem.empty()) Fault(Where(key), full + ": " + problem);
}

void Loader::SettleOptionalGroups() {
  for (const OptionalGroup& group : keys_.optional_groups) {
    std::vector<std::string> missing;
    for (const std::string& field : group.fields) {
      if (!given_.contains(field)) missing.push_back(field);
    }
    if (missing.size() == group.fields.size()) {
      group.disengage();
      continue;
    }
    for (const std::string& field : missing) {
      refused_.insert(field);
      const bool has_forms = field.ends_with(std::string(".") + kRotationKey);
      Fault(given_[group.path],
            field + (has_forms ? " (or rotation_rpy_deg, rotation_matrix, matrix)" : "") +
                ": is missing; the keys of its group go together");
    }
  }
}

// Checks that the lidar model has a beam table, because the core does not look for files.
std::vector<OptionFault> CheckLidarModel(const Options& options) {
  const std::string& model = options.rig.lidar.model;
  if (model == "generic") return {};
  try {
    (void)LoadBeamTable(model);
    return {};
  } catch (const std::runtime_error& error) {
    return {{"rig.lidar.model", error.what()}};
  }
}

LoadResult Loader::Finish() {
  SettleOptionalGroups();
  std::vector<OptionFault> faults = Validate(result_.options);
  const auto is_of_model = [](const OptionFault& f) { return f.key == "rig.lidar.model"; };
  if (std::none_of(faults.begin(), faults.end(), is_of_model)) {
    const std::vector<OptionFault> more = CheckLidarModel(result_.options);
    faults.insert(faults.end(), more.begin(), more.end());
  }
  for (const OptionFault& fault : faults) {
    if (refused_.contains(fault.key)) continue;  // its value was refused, which is reported already
    const auto where = given_.find(fault.key);
    // A key that is not given may be in the file that could not be used: that fault comes first.
    if (where == given_.end() && is_file_unusable_) continue;
    Fault(where == given_.end() ? "configuration" : where->second,
          fault.key + ": " + fault.message);
  }
  return std::move(result_);
}

}  // namespace

LoadResult LoadOptions(const std::vector<std::filesystem::path>& files,
                       const std::vector<std::string>& sets) {
  Loader loader;
  for (const std::filesystem::path& file : files) loader.ApplyFile(file);
  for (const std::string& set : sets) loader.ApplySet(set);
  return loader.Finish();
}

}  // namespace lio
