// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/files/file_controller.h"

#include "annotation/exchange.h"
#include "app/gui/scene/document_controller.h"
#include "app/gui/scene/scene_opener.h"
#include "app/gui/scene/scene_switcher.h"
#include "app/gui/scene/viewer_area.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/dialogs.h"
#include "app/gui/shell/features.h"
#include "app/gui/shell/frame.h"
#include "app/gui/shell/jobs.h"
#include "app/session/load_scene.h"
#include "app/session/project_file.h"
#include "app/session/result_files.h"
#include "app/session/session.h"
#include "engine/core/error.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/aside_delegate.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/parameter_form.h"
#include "widgets/controls/text.h"
#include "widgets/controls/theme.h"

#include <QAction>
#include <QCoreApplication>
#include <QDialog>
#include <QDialogButtonBox>
#include <QDropEvent>
#include <QFileInfo>
#include <QLabel>
#include <QListWidget>
#include <QMenu>
#include <QMessageBox>
#include <QMimeData>
#include <QPushButton>
#include <QSettings>
#include <QUrl>

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace episcope {
namespace {

/// Lists the built-in scenes; of the random one, asks for seed and kind. Double click or Return
/// opens one.
class BuiltinDialog : public QDialog {
  Q_OBJECT

 public:
  explicit BuiltinDialog(QWidget* parent);

  /// What a command line opens: "demo:random?seed=7&kind=thin".
  [[nodiscard]] QString input() const;

 private:
  void listScenes();
  void showChosen();
  [[nodiscard]] QString scene() const;

  QListWidget* scenes_;
  ParameterForm* form_;
  QLabel* written_;
};

constexpr int kBuiltinWidth = 620;
constexpr double kLargestSeed = 999;

std::vector<ParameterDescription> random_parameters() {
  const scenes::RenderOptions defaults;
  ParameterDescription seed{
      .key = "seed",
      .label = QT_TRANSLATE_NOOP("episcope::Schema", "Seed"),
      .help = QT_TRANSLATE_NOOP("episcope::Schema", "Each number is another scene"),
      .unit = "",
      .default_value = static_cast<int>(defaults.seed),
      .min = 0,
      .max = kLargestSeed,
  };
  ParameterDescription kind{
      .key = "kind",
      .label = QT_TRANSLATE_NOOP("episcope::Schema", "Kind"),
      .help = QT_TRANSLATE_NOOP("episcope::Schema", "What the scene is made of; any is a mixture"),
      .unit = "",
      .default_value = name_of(defaults.kind),
      .choices = all_names<scenes::RandomKind>(),
  };
  return {std::move(seed), std::move(kind)};
}

BuiltinDialog::BuiltinDialog(QWidget* parent)
    : QDialog(parent),
      scenes_(named("builtin.scenes", new QListWidget(this))),
      form_(new ParameterForm(this)),
      written_(named("builtin.written", new QLabel(this))) {
  setObjectName("builtin");
  setWindowTitle(tr("Built-in scenes"));
  scenes_->setItemDelegate(new AsideDelegate(AsideDelegate::Place::Column, scenes_));
  listScenes();
  form_->setParameters(random_parameters());
  written_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  theme::mute(written_);
  auto* answers = make_answers(this, "builtin.open", tr("Open"));
  make_column(this, {{scenes_, 1}, form_, written_, answers}, {.margins = kStyleMargins});
  connect(scenes_, &QListWidget::itemDoubleClicked, this, &QDialog::accept);
  connect(scenes_, &QListWidget::currentItemChanged, this, &BuiltinDialog::showChosen);
  connect(form_, &ParameterForm::valuesChanged, this, &BuiltinDialog::showChosen);
  scenes_->setCurrentRow(0);
  resize(kBuiltinWidth, sizeHint().height());
}

void BuiltinDialog::listScenes() {
  for (const scenes::BuiltinSceneInfo& info : builtin_inputs()) {
    auto* item = new QListWidgetItem(QString::fromStdString(info.id), scenes_);
    item->setData(AsideDelegate::kAsideRole, schema_text(info.summary));
    item->setToolTip(schema_text(info.summary));
  }
}

void BuiltinDialog::showChosen() {
  form_->setEnabled(scene() == scenes::kRandomScene);
  written_->setText(tr("On a command line: %1").arg(input()));
}

QString BuiltinDialog::scene() const {
  const QListWidgetItem* item = scenes_->currentItem();
  return item ? item->text() : QString();
}

QString BuiltinDialog::input() const {
  const QString id = scene();
  if (id != scenes::kRandomScene) return "demo:" + id;
  scenes::RenderOptions options;
  const ParameterSet values = form_->values();
  options.seed = static_cast<unsigned>(std::get<int>(values.at(0).second));
  options.kind = value_named<scenes::RandomKind>(std::get<std::string>(values.at(1).second));
  return "demo:" + QString::fromStdString(scenes::builtin_text(id.toStdString(), options));
}

}  // namespace

FileController::FileController(const Workbench& bench)
    : QObject(&bench.owner), bench_(bench), recent_menu_(new QMenu(&bench.window)) {
  addOpenCommands();
  addSaveCommand();
  addLeaveCommands();
  fillRecentMenu();
  bench.commands.addTargets([this] {
    std::vector<PaletteTarget> found;
    for (const QString& input : recent_inputs()) {
      found.push_back({tr("Recent: %1").arg(input), tr("Opens it again"), {}, [this, input] {
                         bench_.opener.open(input);
                       }});
    }
    return found;
  });
  add_start_strip(bench, recent_menu_);
  bench.window.setAcceptDrops(true);
  bench.window.installEventFilter(this);
  connect(&bench.opener, &SceneOpener::opened, this, &FileController::remember);
  connect(&bench.opener, &SceneOpener::isCollection, this, &FileController::remember);
  connect(&bench.opener, &SceneOpener::isProject, this, &FileController::remember);
  connect(&bench.commands, &Commands::keysChanged, this, &FileController::showInvitation);
  bench.session.on_changed([this](Parts parts) {
    if (parts.has(Part::Scenes)) showInvitation();
  });
  // One of the open ones may have to be read.
  const auto follow = [this] {
    if (!bench_.session.scenes().empty()) showInvitation();
  };
  connect(&bench.jobs, &Jobs::added, this, follow);
  connect(&bench.jobs, &Jobs::removed, this, follow);
  showInvitation();
}

void FileController::remember(const QString& input) {
  if (is_builtin(input)) return;
  remember_recent(input);
  begin_dialogs_beside(input);
  fillRecentMenu();
}

void FileController::addOpenCommands() {
  const auto add = [this](const QString& id, const QString& text, const QString& tip,
                          const QList<QKeySequence>& keys, void (FileController::*run)()) {
    return Command{.id = id,
                   .menu = Menu::Open,
                   .text = text,
                   .tip = tip,
                   .keys = keys,
                   .run = [this, run] { (this->*run)(); },
                   .section = section::kOpen};
  };
  Command open =
      add("file.open", tr("File or folder…"),
          tr("Opens a file or a folder: a light field, a folder of several, a result or a project"),
          {QKeySequence::Open, tr("Ctrl+Shift+O")}, &FileController::ask);
  open.icon = "open";
  open.bar = BarSection::Files;
  bench_.commands.add(std::move(open));
  Command again =
      add("file.read_again", tr("Read again"),
          tr("Reads the open light field again, with what a program has added to its file since"),
          {tr("Ctrl+F5")}, &FileController::readAgain);
  again.menu = Menu::File;
  again.section = section::kReading;
  again.enabled = [this] { return !bench_.opener.reopenable().isEmpty(); };
  bench_.commands.add(std::move(again));
  Command result =
      add("file.open_result", tr("Result…"), tr("Adds a result from a file to the list"),
          {tr("Ctrl+R")}, &FileController::askForResult);
  result.enabled = [this] { return bench_.session.scene() != nullptr; };
  bench_.commands.add(std::move(result));
  bench_.commands.add({.menu = Menu::Open, .section = section::kOpen},
                      {{.id = "file.recent",
                        .text = tr("Recent"),
                        .tip = tr("Reopens a recent light field"),
                        .enabled = [this] { return !recent_menu_->isEmpty(); },
                        .submenu = recent_menu_},
                       {.id = "file.demo",
                        .text = tr("Demo"),
                        .tip = tr("Opens the built-in demo scene"),
                        .run = [this] { bench_.opener.open("demo"); }}});
  bench_.commands.add(add("file.builtin", tr("Built-in scenes…"),
                          tr("Opens one of the built-in scenes, or a random one of a seed"), {},
                          &FileController::askForBuiltin));
}

void FileController::addSaveCommand() {
  bench_.commands.add(
      {.id = "file.save_as",
       .menu = Menu::Export,
       .text = tr("Light field"),
       .tip = tr("Writes the light field, its ground truth and its labels in another form"),
       .section = section::kField,
       .enabled = [this] { return bench_.session.scene() != nullptr; },
       .submenu = make_save_menu(bench_)});
}

void FileController::addLeaveCommands() {
  bench_.commands.add({.menu = Menu::File, .section = section::kLeave},
                      {{.id = "file.close",
                        .text = tr("Close"),
                        .tip = tr("Closes the light field"),
                        .keys = {tr("Ctrl+W")},
                        .run = [this] { bench_.opener.close(); },
                        .enabled = [this] { return bench_.session.scene() != nullptr; }},
                       {.id = "file.quit",
                        .text = tr("Quit"),
                        .tip = tr("Quits Episcope"),
                        .keys = {tr("Ctrl+Q")},
                        .run = [this] { bench_.window.close(); }}});
}

// Without a filter: too many forms can be opened for a list of suffixes.
void FileController::ask() {
  ask_for_file_or_folder(
      &bench_.window,
      {.name = "open_file", .title = tr("Open a light field, a result or a project")},
      [this](const QString& path) {
        is_result(path) ? openResult(path) : bench_.opener.open(path);
      });
}

void FileController::readAgain() {
  bench_.opener.reopen();
}

void FileController::askForResult() {
  ask_for_file(&bench_.window,
               {.name = "open_result",
                .title = tr("Open a result"),
                .filter = tr("Results (*.h5 *.hdf5 *.pfm *.tif *.tiff *.npy *.npz *.mat "
                             "*.csv);;All files (*)")},
               [this](const QString& path) { openResult(path); });
}

void FileController::askForBuiltin() {
  auto* dialog = new BuiltinDialog(&bench_.window);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  connect(dialog, &QDialog::accepted, this,
          [this, dialog] { bench_.opener.open(dialog->input()); });
  dialog->open();
}

void FileController::openResult(const QString& path, const QStringList& rest,
                                const QStringList& failures) {
  bench_.jobs.start<ResultOwner>(
      Lane::Load, tr("Opening %1").arg(QFileInfo(path).fileName()),
      [path = path.toStdString(), front = bench_.session.light_field(),
       input = bench_.session.input()](const Progress&) {
        try {
          return owner_of_result(path, front.get(), input);
        } catch (const IoError&) {
          return ResultOwner();  // Whoever opens it says so, and goes on with the others.
        }
      },
      [this, path, rest, failures](const ResultOwner& owner) {
        const bool is_of_front =
            owner.input.empty() || is_same_input(owner.input, bench_.session.input());
        if (!bench_.session.scene()) {
          // Of an unknown owner the opener says what is wrong.
          return is_of_front ? openFirst(path, rest, failures)
                             : openOwner(path, owner, rest, failures);
        }
        is_of_front ? bench_.results.open(path) : askWhereItBelongs(path, owner);
        openAll(rest, failures);
      });
}

void FileController::askWhereItBelongs(const QString& path, const ResultOwner& owner) {
  const QString name = QFileInfo(path).fileName();
  const QString input = QString::fromStdString(owner.input);
  auto* box = new_question_box(
      &bench_.window,
      {.name = "result_owner",
       .title = tr("Result of another light field"),
       .text = (owner.is_stated ? tr("%1 was estimated from the light field %2.")
                                : tr("%1 lies in the folder of the light field %2."))
                   .arg(name, input)});
  auto* open = box->addButton(tr("Open that light field"), QMessageBox::AcceptRole);
  open->setObjectName("result_owner.open");
  box->setDefaultButton(open);
  connect(open, &QPushButton::clicked, this, [this, path, owner] { openOwner(path, owner); });
  auto* add = box->addButton(
      tr("Add to “%1”").arg(QString::fromStdString(bench_.session.light_field()->info().name)),
      QMessageBox::DestructiveRole);
  add->setObjectName("result_owner.add");
  connect(add, &QPushButton::clicked, this, [this, path] {
    if (bench_.session.scene()) bench_.results.openForeign(path);
  });
  box->open();
}

// A map beside views may be their truth, which is read with them.
void FileController::openOwner(const QString& path, const ResultOwner& owner,
                               const QStringList& rest, const QStringList& failures) {
  const auto scenes = bench_.session.scenes();
  const auto known = std::ranges::find_if(
      scenes, [&](const OpenScene* each) { return is_same_input(each->input, owner.input); });
  const std::string input = known == scenes.end() ? owner.input : (*known)->input;
  const auto add = [this, path, owner] {
    owner.is_stated ? bench_.results.open(path) : bench_.results.offer(path);
  };
  openFirst(QString::fromStdString(input), rest, failures, add);
}

// Opens one after the other, since each replaces the one being opened; a project first, since it
// replaces all; results last, since they belong to a light field.
void FileController::openAll(QStringList paths, const QStringList& failures) {
  std::stable_partition(paths.begin(), paths.end(),
                        [](const QString& path) { return !is_result(path); });
  std::stable_partition(paths.begin(), paths.end(),
                        [](const QString& path) { return names_project(path_of(path)); });
  if (paths.isEmpty()) {
    // One alone is told in place of the view.
    const bool is_told = failures.size() == 1 && !bench_.session.scene();
    if (!failures.isEmpty() && !is_told) bench_.messages.fail(failures.join('\n'));
    return;
  }
  const QString path = paths.takeFirst();
  if (bench_.session.scene() && is_result(path)) {
    openResult(path);
    openAll(paths, failures);
  } else if (is_result(path)) {
    openResult(path, paths, failures);
  } else {
    openFirst(path, paths, failures);
  }
}

void FileController::openFirst(const QString& path, const QStringList& rest,
                               const QStringList& failures, const std::function<void()>& then) {
  const auto go_on = [this, rest, failures](const QString& failure) {
    openAll(rest, failure.isEmpty() ? failures : QStringList(failures) << failure);
  };
  const auto opened = [go_on, then] {
    if (then) then();
    go_on({});
  };
  bench_.opener.open(path, opened, go_on);
}

void FileController::fillRecentMenu() {
  recent_menu_->clear();
  for (const QString& input : recent_inputs()) {
    recent_menu_->addAction(input, this, [this, input] { bench_.opener.open(input); });
  }
  if (!recent_menu_->isEmpty()) {
    recent_menu_->addSeparator();
    recent_menu_->addAction(tr("Clear list"), this, [this] {
      forget_recent();
      fillRecentMenu();
    });
  }
  bench_.commands.refresh();
}

void FileController::showInvitation() {
  const QString key = bench_.commands.keyText("file.open");
  const bool has_scenes = !bench_.session.scenes().empty();
  const auto opening = bench_.jobs.running(Lane::Open);
  bench_.viewer_area.canvas()->setEmptyHint(
      has_scenes && !opening.empty() ? opening.back().title + QStringLiteral(" …")
      : has_scenes                   ? tr("Choose one in the list at the upper left.")
      : key.isEmpty()
          ? tr("Open a light field, or drop a file or a folder here.")
          : tr("Open a light field with %1, or drop a file or a folder here.").arg(key));
}

bool FileController::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() != QEvent::DragEnter && event->type() != QEvent::Drop) {
    return QObject::eventFilter(watched, event);
  }
  auto* drop = static_cast<QDropEvent*>(event);
  const QList<QUrl> urls = drop->mimeData()->urls();
  if (urls.isEmpty() || !urls.front().isLocalFile()) return false;
  drop->acceptProposedAction();
  if (event->type() != QEvent::Drop) return true;
  QStringList paths;
  for (const QUrl& url : urls) {
    if (url.isLocalFile()) paths << url.toLocalFile();
  }
  open(paths);
  return true;
}

namespace {

constexpr const char* kKey = "recent";
constexpr int kMostRecent = 10;

}  // namespace

QStringList recent_inputs() {
  return QSettings().value(kKey).toStringList();
}

void remember_recent(const QString& input) {
  QStringList recent = recent_inputs();
  recent.removeAll(input);
  recent.prepend(input);
  QSettings().setValue(kKey, recent.mid(0, kMostRecent));
}

void forget_recent() {
  QSettings().remove(kKey);
}

namespace {

namespace fs = std::filesystem;

struct SaveFormsText {
  Q_DECLARE_TR_FUNCTIONS(episcope::SaveForms)
};

/// What a user calls a form; its name in the engine if it has no other.
QString title_of(const io::Writer& writer) {
  const std::pair<const char*, QString> titles[] = {
      {"archive", SaveFormsText::tr("Archive file (HDF5)")},
      {"benchmark", SaveFormsText::tr("Folder of the 2016 benchmark")},
      {"grid", SaveFormsText::tr("Folder of images")},
      {"npy", SaveFormsText::tr("NumPy array")},
      {"npz", SaveFormsText::tr("NumPy arrays with ground truth and labels")},
      {"mat", SaveFormsText::tr("MATLAB file of the Light Field Toolbox")},
      {"eslf", SaveFormsText::tr("Picture of lenslets (ESLF)")},
      {"quilt", SaveFormsText::tr("Quilt for light-field displays")}};
  for (const auto& [id, title] : titles) {
    if (writer.id == std::string_view(id)) return title;
  }
  return QString::fromUtf8(writer.name);
}

/// Whether a file is the light field that is open, or lies in its folder already.
bool is_open_light_field(const fs::path& path, const fs::path& input) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return false;
  return fs::equivalent(path, input, ignored) ||
         (fs::is_directory(input, ignored) && fs::equivalent(path.parent_path(), input, ignored));
}

/// The scene with what is painted now in place of what was read.
Scene scene_to_save(const Workbench& bench) {
  Scene scene = *bench.session.scene();
  if (bench.document.document() == nullptr) return scene;
  bench.document.endStroke();
  scene.scribbles = scribbles_of(*bench.document.document());
  return scene;
}

QString joined_sentences(const QString& first, const std::vector<std::string>& others) {
  QString text = first;
  for (const std::string& sentence : others) text += ' ' + QString::fromStdString(sentence);
  return text;
}

}  // namespace

QMenu* make_save_menu(const Workbench& bench) {
  auto* menu = new QMenu(&bench.window);
  for (const io::Writer& writer : io::writers()) {
    QAction* action = menu->addAction(SaveFormsText::tr("%1…").arg(title_of(writer)), &bench.owner,
                                      [bench, &writer] { ask_to_save_light_field(bench, writer); });
    action->setObjectName(QString("file.save_as.%1").arg(writer.id));
  }
  return menu;
}

void ask_to_save_light_field(const Workbench& bench, const io::Writer& writer) {
  const LightFieldPtr light_field = bench.session.light_field();
  if (!light_field) return;
  const QString name = QString::fromStdString(light_field->info().name);
  const QString suffix = writer.writes_folder() ? QString() : QString(writer.suffixes.front());
  ask_where_to_save(
      bench,
      {.name = "save_light_field",
       .title = SaveFormsText::tr("Save %1: %2").arg(name, title_of(writer)),
       .filter = writer.writes_folder() ? SaveFormsText::tr("New folders (*)")
                                        : QString("%1 (*%2)").arg(title_of(writer), suffix),
       .proposal = name + '_' + writer.id + suffix},
      [bench, &writer](const QString& path) { save_light_field(bench, writer, path); });
}

void save_light_field(const Workbench& bench, const io::Writer& writer, const QString& path) {
  if (!bench.session.scene()) return;
  const fs::path file = path.toStdString();
  if (!writer.writes_folder() && !writer.has_suffix_of(file)) {
    bench.messages.warn(SaveFormsText::tr("%1 was not written: its name must end in %2.")
                            .arg(QFileInfo(path).fileName(), writer.suffixes.front()));
    return;
  }
  if (is_open_light_field(file, bench.session.input())) {
    bench.messages.warn(
        SaveFormsText::tr("%1 was not written: it belongs to the light field that is open; "
                          "choose another name.")
            .arg(QFileInfo(path).fileName()));
    return;
  }
  auto scene = std::make_shared<const Scene>(scene_to_save(bench));
  bench.jobs.start<std::vector<std::string>>(
      Lane::Export, SaveFormsText::tr("Writing %1").arg(QFileInfo(path).fileName()),
      [scene, file, &writer](const Progress& progress) {
        writer.write(file, *scene, progress);
        return io::unsupported_parts(writer, *scene);
      },
      [&messages = bench.messages, path](const std::vector<std::string>& losses) {
        if (losses.empty()) return messages.written(path);
        messages.hint(joined_sentences(SaveFormsText::tr("Saved: %1.").arg(path), losses));
      });
}

}  // namespace episcope

#include "file_controller.moc"
#include "moc_file_controller.cpp"
