// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/collection/collection_controller.h"

#include "app/gui/collection/thumbnail_queue.h"
#include "app/gui/document/document_controller.h"
#include "app/gui/frame/commands.h"
#include "app/gui/frame/dialogs.h"
#include "app/gui/frame/frame.h"
#include "app/gui/frame/jobs.h"
#include "app/gui/frame/queued_post.h"
#include "app/gui/opening/scene_opener.h"
#include "app/gui/opening/scene_switcher.h"
#include "app/session/project/scene_work.h"
#include "app/session/scene/collections.h"
#include "app/session/session.h"
#include "widgets/collection/scene_list.h"
#include "widgets/collection/scene_panel.h"

#include <QAction>
#include <QFileInfo>

#include <algorithm>
#include <functional>
#include <utility>

namespace episcope {
namespace {

QString text_of(const std::string& text) {
  return QString::fromStdString(text);
}

QString shape_text(const io::SceneProbe& probe) {
  QStringList parts;
  if (probe.frames > 0) {
    parts += CollectionController::tr("%1 frames").arg(probe.frames);
  }
  if (probe.grid.count() > 0) parts += QString("%1×%2").arg(probe.grid.v).arg(probe.grid.u);
  if (probe.list > 0 && probe.grid.count() == 0) {
    parts += CollectionController::tr("%1 views").arg(probe.list);
  }
  if (probe.width > 0) parts += QString("%1×%2 px").arg(probe.width).arg(probe.height);
  if (probe.channels == 1) parts += CollectionController::tr("grey");
  if (probe.sample_type == SampleType::UInt16) parts += CollectionController::tr("16 bit");
  if (probe.sample_type == SampleType::Float32) parts += CollectionController::tr("float");
  return parts.join(QStringLiteral(" · "));
}

SceneItem item_of(const io::CollectionEntry& entry) {
  const io::SceneProbe& probe = entry.probe;
  SceneItem item;
  item.path = text_of(entry.path.string());
  item.name = text_of(entry.name);
  item.form =
      entry.problem.empty() ? text_of(entry.reader) : CollectionController::tr("cannot be opened");
  item.shape = shape_text(probe);
  item.has_truth = !probe.truth.empty();
  if (item.has_truth) item.parts += text_of(probe.truth);
  if (!probe.labels.empty()) item.parts += text_of(probe.labels);
  if (!entry.results.empty()) {
    item.parts += entry.results.size() == 1
                      ? CollectionController::tr("1 result")
                      : CollectionController::tr("%1 results").arg(entry.results.size());
  }
  // Which file it is about stands above it.
  item.problem = text_of(entry.problem);
  const QString prefix = item.path + ": ";
  if (item.problem.startsWith(prefix)) item.problem.remove(0, prefix.size());
  item.samples =
      static_cast<qint64>(std::max(probe.grid.count(), probe.list)) * probe.width * probe.height;
  return item;
}

}  // namespace

CollectionController::CollectionController(const Workbench& bench)
    : QObject(&bench.owner),
      bench_(bench),
      list_(new SceneList(this)),
      panel_(new ScenePanel(list_, &bench.frame)),
      thumbnails_(new ThumbnailQueue(this)) {
  bench.frame.addTab({.id = "collection",
                      .title = tr("Scenes"),
                      .command_text = tr("Scenes tab"),
                      .command_tip = tr("Shows the light fields of a folder"),
                      .widget = panel_});
  addCommands();
  connect(panel_, &ScenePanel::openRequested, this, [this](const QString& path) { open(path); });
  connect(list_, &SceneList::thumbnailWanted, this, [this](const QString& path) {
    const auto entry = entries_.constFind(path);
    if (entry != entries_.cend()) thumbnails_->want(*entry, bench_.opener.cacheFolder());
  });
  connect(thumbnails_, &ThumbnailQueue::made, list_, &SceneList::setThumbnail);
  connect(&bench.opener, &SceneOpener::isCollection, this, &CollectionController::openCollection);
  bench.session.on_changed([this](Parts parts) {
    if (parts.has(Part::Scene)) markOpen();
  });
}

void CollectionController::addStep(const QString& id, const QString& text, const QString& tip,
                                   Qt::Key key, int step) {
  bench_.commands.add({.id = "collection." + id,
                       .menu = Menu::File,
                       .text = text,
                       .tip = tip,
                       .keys = {QKeySequence(key)},
                       .run = [this, step] { this->step(step); },
                       .section = section::kOpen,
                       .enabled = [this] { return list_->rowCount() > 0; }});
}

void CollectionController::addCommands() {
  QAction* open = bench_.commands.add(
      {.id = "collection.open",
       .menu = Menu::File,
       .text = tr("Open collection…"),
       .tip = tr("Lists every light field in a folder and in the folders inside"),
       .icon = "open",
       .run =
           [this] {
             ask_for_folder(
                 &bench_.window,
                 {.name = "open_collection", .title = tr("Open a folder of light fields")},
                 [this](const QString& folder) { openCollection(folder); });
           },
       .section = section::kOpen});
  panel_->setOpenAction(open);
  addStep("next", tr("Next scene"), tr("Opens the next light field of the collection"),
          Qt::Key_PageDown, 1);
  addStep("previous", tr("Previous scene"), tr("Opens the light field before in the collection"),
          Qt::Key_PageUp, -1);
}

void CollectionController::openCollection(const QString& folder) {
  bench_.frame.showTab("collection");
  bench_.jobs.cancel(std::exchange(job_, 0));
  if (folder != folder_) {
    thumbnails_->clear();
    list_->clear();
    entries_.clear();
  }
  folder_ = folder;
  panel_->setFolder(folder, true);
  // The searching thread ends with the jobs, after this object: posts go by way of the jobs.
  const quint64 search = ++search_;
  job_ = bench_.jobs.start<std::vector<io::CollectionEntry>>(
      Lane::List, tr("Listing %1").arg(QFileInfo(folder).fileName()),
      [this, search, folder, cache = bench_.opener.cacheFolder(),
       post = queued_post(&bench_.jobs)](const Progress& progress) {
        const auto on_entry = [&](const io::CollectionEntry& entry) {
          post([this, search, entry] {
            if (search == search_) add(entry);
          });
        };
        return list_collection(folder.toStdString(), cache, on_entry, progress);
      },
      [this, search](const std::vector<io::CollectionEntry>& entries) {
        if (search == search_) finish(entries);
      },
      [this, search, folder] {
        if (search == search_) panel_->setFolder(folder, false);
        bench_.commands.refresh();
      });
}

void CollectionController::add(const io::CollectionEntry& entry) {
  const SceneItem item = item_of(entry);
  entries_[item.path] = entry;
  list_->add(item);
}

void CollectionController::finish(const std::vector<io::CollectionEntry>& entries) {
  std::vector<SceneItem> items;
  entries_.clear();
  for (const io::CollectionEntry& entry : entries) {
    items.push_back(item_of(entry));
    entries_[items.back().path] = entry;
  }
  list_->setItems(items);
  markOpen();
}

QString CollectionController::openPath() const {
  const QString input = QString::fromStdString(bench_.session.input());
  if (entries_.contains(input) || is_builtin(input)) return input;
  // lf.h5 of a folder that is listed.
  const QString folder = QFileInfo(input).absolutePath();
  return entries_.contains(folder) ? folder : input;
}

void CollectionController::markOpen() {
  wanted_.clear();
  list_->setOpen(openPath());
  panel_->reveal(openPath());
}

void CollectionController::step(int step) {
  // A key that repeats goes on from what is loading.
  const QString path = panel_->neighbour(wanted_.isEmpty() ? openPath() : wanted_, step);
  if (path.isEmpty()) return;
  panel_->reveal(path);
  open(path);
}

void CollectionController::open(const QString& path) {
  wanted_ = path;
  std::function<void()> then;
  if (entries_.contains(openPath())) {
    then = [this, former = bench_.session.generation()] { closeIfUntouched(former); };
  }
  bench_.opener.open(path, std::move(then));
}

bool CollectionController::isTouched(const OpenScene& scene) const {
  const auto edited = bench_.document.editedDocuments();
  const auto& sweeps = bench_.scenes.sweeps().all();
  return !scene.estimates.empty() || !scene.unread.empty() || !scene.unread_strokes.empty() ||
         scene.labels.covers_many() || has_work(scene.place) ||
         bench_.jobs.count(Lane::Estimate) > 0 ||
         std::ranges::count(edited, scene.id, &EditedDocument::scene) > 0 ||
         std::ranges::any_of(sweeps, [&](const Sweep& sweep) {
           return std::ranges::count(sweep.scenes, scene.id, &SweepScene::scene) > 0;
         });
}

// Who goes through a collection does not want all of it open.
void CollectionController::closeIfUntouched(std::uint64_t id) {
  const OpenScene* scene = bench_.session.find_scene(id);
  if (scene && !isTouched(*scene)) bench_.session.remove(id);
}

}  // namespace episcope

#include "moc_collection_controller.cpp"
