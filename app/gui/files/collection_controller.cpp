// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/shell/features.h"

#include "app/gui/scene/document_controller.h"
#include "app/gui/scene/scene_opener.h"
#include "app/gui/scene/scene_switcher.h"
#include "app/gui/scene/viewer_area.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/dialogs.h"
#include "app/gui/shell/frame.h"
#include "app/gui/shell/jobs.h"
#include "app/gui/shell/workbench.h"
#include "app/session/collections.h"
#include "app/session/open_scene.h"
#include "app/session/session.h"
#include "engine/core/jobs.h"
#include "engine/core/parallel.h"
#include "engine/io/formats/collection.h"
#include "widgets/canvas/canvas_geometry.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/panels/scene_panel.h"

#include <QAction>
#include <QCoreApplication>
#include <QFileInfo>
#include <QHash>
#include <QImage>
#include <QObject>
#include <QString>
#include <QTimer>

#include <algorithm>
#include <deque>
#include <filesystem>
#include <functional>
#include <optional>
#include <utility>

namespace episcope {
namespace {

QImage to_image(const Image<std::uint8_t>& rgb) {
  return QImage(rgb.data(), rgb.width(), rgb.height(), 3 * rgb.width(), QImage::Format_RGB888)
      .copy();
}

}  // namespace

/// Makes thumbnails in the background, one after the other, those asked for last first: they are
/// the ones on screen.
class ThumbnailQueue : public QObject {
  Q_OBJECT

 public:
  explicit ThumbnailQueue(QObject* parent);

  /// Thumbnails are kept in `cache_folder`; empty = nowhere.
  void want(const io::CollectionEntry& entry, const std::filesystem::path& cache_folder);
  /// Forgets what was asked for.
  void clear();

 signals:
  /// Not emitted for light fields that cannot be read.
  void made(const QString& path, const QImage& thumbnail);

 private:
  void next();

  struct Wanted {
    io::CollectionEntry entry;
    std::filesystem::path cache_folder;
  };

  std::deque<Wanted> wanted_;
  bool is_busy_ = false;
  quint64 number_ = 0;  // of the collection
  JobRunner runner_;
};

ThumbnailQueue::ThumbnailQueue(QObject* parent) : QObject(parent), runner_(queued_post(this)) {}

void ThumbnailQueue::want(const io::CollectionEntry& entry,
                          const std::filesystem::path& cache_folder) {
  wanted_.push_back({entry, cache_folder});
  next();
}

void ThumbnailQueue::clear() {
  wanted_.clear();
  ++number_;
  runner_.cancel_all();
}

void ThumbnailQueue::next() {
  if (is_busy_ || wanted_.empty()) return;
  const Wanted wanted = std::move(wanted_.back());
  wanted_.pop_back();
  is_busy_ = true;
  runner_.start<QImage>(
      [wanted](const Progress& progress) {
        lower_thread_priority();
        return to_image(scene_thumbnail(wanted.entry, wanted.cache_folder, progress));
      },
      [this, number = number_,
       path = QString::fromStdString(wanted.entry.path.string())](const Outcome<QImage>& outcome) {
        is_busy_ = false;
        if (number == number_ && outcome.value) emit made(path, *outcome.value);
        next();
      });
}

namespace {

struct CollectionControllerText {
  Q_DECLARE_TR_FUNCTIONS(episcope::CollectionController)
};

QString text_of(const std::string& text) {
  return QString::fromStdString(text);
}

/// What a user calls the form that a reader reads; its id if it has no other name.
QString form_text(const std::string& reader) {
  const std::pair<const char*, QString> titles[] = {
      {"archive", CollectionControllerText::tr("2013 archive")},
      {"benchmark2016", CollectionControllerText::tr("2016 benchmark")},
      {"image_grid", CollectionControllerText::tr("images")},
      {"mosaic", CollectionControllerText::tr("views in one picture")},
      {"sequence", CollectionControllerText::tr("sequence")},
      {"frames", CollectionControllerText::tr("pages or film")},
      {"hdf5", "HDF5"},
      {"matlab", "MATLAB"},
      {"numpy", "NumPy"},
      {"blender", "Blender"}};
  for (const auto& [id, title] : titles) {
    if (reader == id) return title;
  }
  return text_of(reader);
}

QString shape_text(const io::SceneProbe& probe) {
  QStringList parts;
  if (probe.frames > 0) {
    parts += CollectionControllerText::tr("%1 frames").arg(probe.frames);
  }
  if (probe.grid.count() > 0) parts += QString("%1×%2").arg(probe.grid.v).arg(probe.grid.u);
  if (probe.list > 0 && probe.grid.count() == 0) {
    parts += CollectionControllerText::tr("%1 views").arg(probe.list);
  }
  if (probe.width > 0) parts += QString("%1×%2 px").arg(probe.width).arg(probe.height);
  if (probe.channels == 1) parts += CollectionControllerText::tr("grey");
  if (probe.sample_type == SampleType::UInt16) parts += CollectionControllerText::tr("16 bit");
  if (probe.sample_type == SampleType::Float32) parts += CollectionControllerText::tr("float");
  return parts.join(QStringLiteral(" · "));
}

SceneItem item_of(const io::CollectionEntry& entry) {
  const io::SceneProbe& probe = entry.probe;
  SceneItem item;
  item.path = text_of(entry.path.string());
  item.name = text_of(entry.name);
  item.form = entry.problem.empty() ? form_text(entry.reader)
                                    : CollectionControllerText::tr("cannot be opened");
  item.shape = shape_text(probe);
  item.has_truth = !probe.truth.empty();
  if (item.has_truth) item.parts += text_of(probe.truth);
  if (!probe.labels.empty()) item.parts += text_of(probe.labels);
  if (!entry.results.empty()) {
    item.parts += entry.results.size() == 1
                      ? CollectionControllerText::tr("1 result")
                      : CollectionControllerText::tr("%1 results").arg(entry.results.size());
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

/// Lists the light fields below a folder, in the background, and opens them.
class CollectionController : public QObject {
  Q_OBJECT

 public:
  explicit CollectionController(const Workbench& bench)
      : QObject(&bench.owner),
        bench_(bench),
        list_(new SceneList(this)),
        panel_(new ScenePanel(list_, &bench.frame)),
        thumbnails_(new ThumbnailQueue(this)) {
    bench.frame.addTab({.id = "collection",
                        .title = tr("Scenes"),
                        .page = tr("Folder"),
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

  /// Shows the tab and searches a folder, beginning with the entries remembered from last time.
  void openCollection(const QString& folder) {
    bench_.frame.showTab("collection");
    bench_.viewer_area.canvas()->setEmptyHint(tr("Choose a scene in the list."));
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
        [this, search, folder, post = queued_post(&bench_.jobs)](const Progress& progress) {
          const auto on_entry = [&](const io::CollectionEntry& entry) {
            post([this, search, entry] {
              if (search == search_) add(entry);
            });
          };
          return io::find_light_fields(folder.toStdString(), on_entry, progress);
        },
        [this, search](const std::vector<io::CollectionEntry>& entries) {
          if (search == search_) finish(entries);
        },
        [this, search, folder] {
          if (search == search_) panel_->setFolder(folder, false);
          bench_.commands.refresh();
        });
  }

 private:
  void addCommands() {
    QAction* open = bench_.commands.add(
        {.id = "collection.open",
         .menu = Menu::Open,
         .text = tr("Collection…"),
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
    addStep("previous", tr("Previous scene"),
            tr("Opens the previous light field of the collection"), Qt::Key_PageUp, -1);
  }

  void addStep(const QString& id, const QString& text, const QString& tip, Qt::Key key, int step) {
    bench_.commands.add({.id = "collection." + id,
                         .menu = Menu::Open,
                         .text = text,
                         .tip = tip,
                         .keys = {QKeySequence(key)},
                         .run = [this, step] { this->step(step); },
                         .section = section::kScene,
                         .enabled = [this] { return list_->rowCount() > 0; }});
  }

  void add(const io::CollectionEntry& entry) {
    const SceneItem item = item_of(entry);
    entries_[item.path] = entry;
    list_->add(item);
  }

  void finish(const std::vector<io::CollectionEntry>& entries) {
    std::vector<SceneItem> items;
    entries_.clear();
    for (const io::CollectionEntry& entry : entries) {
      items.push_back(item_of(entry));
      entries_[items.back().path] = entry;
    }
    list_->setItems(items);
    markOpen();
  }

  void step(int step) {
    // A repeating key continues from the scene being loaded.
    const QString path = panel_->neighbour(wanted_.isEmpty() ? openPath() : wanted_, step);
    if (path.isEmpty()) return;
    panel_->reveal(path);
    open(path);
  }

  void open(const QString& path) {
    wanted_ = path;
    std::function<void()> then;
    if (entries_.contains(openPath())) {
      then = [this, former = bench_.session.generation()] { closeIfUntouched(former); };
    }
    bench_.opener.open(path, std::move(then));
  }

  /// Whether the user has worked on the scene; untouched scenes are closed when another is opened.
  [[nodiscard]] bool isTouched(const OpenScene& scene) const {
    const auto edited = bench_.document.editedDocuments();
    const auto& sweeps = bench_.scenes.sweeps().all();
    return !scene.estimates.empty() || !scene.unread.empty() || !scene.unread_strokes.empty() ||
           scene.labels.is_worth_keeping() || has_work(scene.place) ||
           bench_.jobs.count(Lane::Estimate) > 0 ||
           std::ranges::count(edited, scene.id, &EditedDocument::scene) > 0 ||
           std::ranges::any_of(sweeps,
                               [&](const Sweep& sweep) { return is_of_scene(sweep, scene.id); });
  }

  // Users who step through a collection do not want all of it open.
  void closeIfUntouched(std::uint64_t id) {
    const OpenScene* scene = bench_.session.find_scene(id);
    if (scene && !isTouched(*scene)) bench_.session.remove(id);
  }

  [[nodiscard]] QString openPath() const {
    const QString input = QString::fromStdString(bench_.session.input());
    if (entries_.contains(input) || is_builtin(input)) return input;
    // lf.h5 of a folder that is listed.
    const QString folder = QFileInfo(input).absolutePath();
    return entries_.contains(folder) ? folder : input;
  }

  void markOpen() {
    wanted_.clear();
    list_->setOpen(openPath());
    panel_->reveal(openPath());
  }

  Workbench bench_;
  SceneList* list_;
  ScenePanel* panel_;
  ThumbnailQueue* thumbnails_;
  QHash<QString, io::CollectionEntry> entries_;  // by path
  QString folder_;
  QString wanted_;  // by the last step, maybe still loading
  quint64 job_ = 0;
  quint64 search_ = 0;  // number of the newest one
};

namespace {

/// Between the frames that are played, ms; longer if reading takes longer.
constexpr int kPlayInterval = 200;

}  // namespace

/// The time slider: opens frames of a sequence, keeping view, cross-hair and zoom.
class FrameController : public QObject {
  Q_OBJECT

 public:
  explicit FrameController(const Workbench& bench)
      : QObject(&bench.owner), bench_(bench), bar_(new TimeBar(&bench.frame)) {
    bench.frame.addLine(Line::Time, bar_);
    addCommands();
    timer_.setSingleShot(true);
    timer_.setInterval(kPlayInterval);
    connect(&timer_, &QTimer::timeout, this, [this] {
      if (is_playing_) step(1);
    });
    connect(bar_, &TimeBar::frameChosen, this, [this](int frame) {
      setPlaying(false);
      open(frame);
    });
    bench.session.on_changed([this](Parts parts) {
      if (parts.has(Part::Scene)) show();
    });
    show();
  }

 private:
  void addCommands() {
    const auto add = [this](const QString& id, const QString& text, const QString& tip,
                            const QKeySequence& key, std::function<void()> run) {
      return Command{.id = "sequence." + id,
                     .menu = Menu::Views,
                     .text = text,
                     .tip = tip,
                     .keys = {key},
                     .run = std::move(run),
                     .section = section::kFrames,
                     .enabled = [this] { return isSequence(); }};
    };
    bench_.commands.add(add("next", tr("Next frame"), tr("Opens the next frame of the sequence"),
                            tr("Alt+Right"), [this] { step(1); }));
    bench_.commands.add(add("previous", tr("Previous frame"),
                            tr("Opens the previous frame of the sequence"), tr("Alt+Left"),
                            [this] { step(-1); }));
    Command play = add("play", tr("Play frames"), tr("Plays the frames of the sequence, or pauses"),
                       tr("Ctrl+Space"), [this] { setPlaying(!is_playing_); });
    play.icon = "play";
    play.checked = [this] { return is_playing_; };
    bar_->setPlayAction(bench_.commands.add(std::move(play)));
  }

  void show() {
    if (!isSequence()) {
      is_playing_ = false;
      bar_->hide();
      return;
    }
    const FrameOfSequence& sequence = bench_.session.scene()->sequence;
    // Whatever is opened is fitted first.
    if (kept_zoom_) bench_.viewer_area.canvas()->setCanvasTransform(*std::exchange(kept_zoom_, {}));
    if (wanted_ < 0) bar_->setFrame(sequence.frame, sequence.count);
    bar_->show();
  }

  void open(int frame) {
    if (!isSequence()) return;
    Session& session = bench_.session;
    wanted_ = frame;
    bench_.opener.reopenFrame(
        frame, [this, &session, frame, view = session.view(), pixel = session.cross_hair()] {
          const ViewCanvas& canvas = *bench_.viewer_area.canvas();
          if (!canvas.isFitted()) kept_zoom_ = canvas.canvasTransform();
          session.set_view(view);
          session.set_cross_hair(pixel);
          if (wanted_ == frame) wanted_ = -1;
          if (is_playing_) timer_.start();
        });
  }

  void step(int step) {
    if (!isSequence()) return;
    const FrameOfSequence& sequence = bench_.session.scene()->sequence;
    const int from = wanted_ >= 0 ? wanted_ : sequence.frame;
    const int count = sequence.count;
    const int frame = is_playing_ ? (from + step) % count : std::clamp(from + step, 0, count - 1);
    if (frame == from) return;
    bar_->setFrame(frame, count);
    open(frame);
  }

  void setPlaying(bool is_playing) {
    is_playing_ = is_playing && isSequence();
    if (is_playing_) step(1);
    bench_.commands.refresh();
  }

  [[nodiscard]] bool isSequence() const {
    return bench_.session.scene() && bench_.session.scene()->sequence.count > 1;
  }

  Workbench bench_;
  TimeBar* bar_;
  QTimer timer_;
  int wanted_ = -1;  // the frame that is loading; -1 = none
  bool is_playing_ = false;
  std::optional<CanvasTransform> kept_zoom_;  // For the frame that comes.
};

// Light fields of a folder, and frames of a sequence.
void add_collection(const Workbench& bench) {
  new CollectionController(bench);
  new FrameController(bench);
}

}  // namespace episcope

#include "collection_controller.moc"
