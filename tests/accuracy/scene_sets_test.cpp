// SPDX-License-Identifier: BSD-3-Clause
#include "tests/accuracy/scene_sets.h"

#include "engine/scenes/builtin.h"
#include "tests/test_main.h"

#include <algorithm>
#include <set>

namespace episcope::in_scene_sets_test {

namespace {

using accuracy::SceneSet;

std::vector<SceneSet> sets() {
  return accuracy::read_scene_sets(EPISCOPE_SCENE_SETS);
}

std::vector<std::string> scenes_of(const SceneSet& set) {
  std::vector<std::string> scenes;
  for (const auto& group : set.groups) {
    scenes.insert(scenes.end(), group.scenes.begin(), group.scenes.end());
  }
  return scenes;
}

bool is_builtin(const std::string& name) {
  return name.starts_with("demo:");
}

scenes::BuiltinRequest request_of(const std::string& name) {
  return scenes::read_request(name.substr(std::string("demo:").size()));
}

}  // namespace

class SceneSetsTest : public QObject {
  Q_OBJECT

 private slots:
  void sets_areTheTwoThatServeThis() {
    const std::vector<SceneSet> all = sets();

    QCOMPARE(all.size(), std::size_t{2});
    QCOMPARE(all[0].name, std::string("choosing"));
    QCOMPARE(all[1].name, std::string("reporting"));
  }

  // Two names for one scene would not help either.
  void sets_areDisjoint() {
    std::set<std::pair<std::string, std::string>> seen;
    for (const SceneSet& set : sets()) {
      for (const std::string& name : scenes_of(set)) {
        const auto key =
            is_builtin(name)
                ? std::make_pair(request_of(name).name(),
                                 std::to_string(request_of(name).options.seed) + "," +
                                     std::to_string(request_of(name).options.noise_sigma))
                : std::make_pair(name, std::string());
        QVERIFY2(seen.insert(key).second, name.c_str());
      }
    }
  }

  void seeds_areOddForChoosingAndEvenForReporting() {
    for (const SceneSet& set : sets()) {
      const unsigned remainder = set.name == "choosing" ? 1 : 0;
      for (const std::string& name : scenes_of(set)) {
        if (!is_builtin(name)) continue;
        QVERIFY2(request_of(name).options.seed % 2 == remainder, name.c_str());
      }
    }
  }

  void choosing_hasNoStoredScene() {
    QVERIFY(std::ranges::all_of(scenes_of(sets()[0]), is_builtin));
  }

  void reporting_hasTheStoredScenes() {
    const std::vector<std::string> scenes = scenes_of(sets()[1]);

    for (const char* name : {"still_life", "cotton"}) {
      QVERIFY2(std::ranges::find(scenes, name) != scenes.end(), name);
    }
  }

  void everyScene_opens() {
    constexpr int size = 16;
    for (const SceneSet& set : sets()) {
      for (const std::string& name : scenes_of(set)) {
        const auto scene = accuracy::open_scene_of_set(name, size, {}, Progress());
        QCOMPARE(scene.has_value(), is_builtin(name));
        if (!scene) continue;
        const int stated = request_of(name).options.width;
        const bool states_size = stated != scenes::RenderOptions{}.width;
        QCOMPARE(scene->light_field->width(), states_size ? stated : size);
      }
    }
  }

  void scenesWith_keepsThoseNamed() {
    const SceneSet kept = accuracy::scenes_with(sets()[0], {"kind=thin", "demo:edge"});

    for (const std::string& name : scenes_of(kept)) {
      QVERIFY2(name.find("thin") != name.npos || name.find("edge") != name.npos, name.c_str());
    }
    QVERIFY(kept.groups.size() < sets()[0].groups.size());
    QVERIFY(scenes_of(kept).size() >= 3);
    QCOMPARE(scenes_of(accuracy::scenes_with(sets()[0], {})), scenes_of(sets()[0]));
  }
};

}  // namespace episcope::in_scene_sets_test

EPISCOPE_TEST(scene_sets_test, SceneSetsTest)
#include "scene_sets_test.moc"
