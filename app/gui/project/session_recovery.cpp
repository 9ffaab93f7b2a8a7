// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/project/session_recovery.h"

#include "app/gui/document/document_controller.h"
#include "app/gui/frame/file_time.h"
#include "app/gui/frame/frame.h"
#include "app/gui/frame/leave_guards.h"
#include "app/gui/frame/messages.h"
#include "app/gui/project/autosave.h"
#include "app/gui/project/restore.h"
#include "app/session/document/unheld_journals.h"
#include "engine/core/error.h"
#include "widgets/controls/message_bar.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace episcope {
namespace {

std::size_t result_count(const Project& project) {
  std::size_t count = 0;
  for (const ProjectScene& scene : project.scenes) count += scene.results.size();
  return count;
}

// The journals that the killed session left: each belongs to the scene that it was painted on. Also
// where all of it is in the user's own project: what is recovered goes on from there.
void name_journals(ReadProject& read, const std::filesystem::path& folder) {
  for (const UnheldJournal& journal : unheld_journals(folder)) {
    try {
      const JournalOwner owner = read_journal(journal.path).owner;
      const auto scene = std::ranges::find(read.project.scenes, owner.source, &ProjectScene::input);
      if (scene != read.project.scenes.end() && scene->strokes.empty()) {
        scene->strokes = journal.path;
      }
    } catch (const IoError&) {
      // Not even its beginning can be read: it is of no scene.
    }
  }
}

}  // namespace

SessionRecovery::SessionRecovery(const Workbench& bench, Autosave& autosave)
    : QObject(&bench.owner),
      bench_(bench),
      autosave_(autosave),
      bar_(new MessageBar(&bench.frame)),
      job_(this) {
  bar_->setObjectName("sessionRecoveryBar");
  bench.frame.addFloating(bar_);
  connect(&bench.frame, &Frame::started, this, &SessionRecovery::look);
}

void SessionRecovery::look() {
  using Left = std::vector<LeftWorkspace>;
  job_.start<Left>([root = autosave_.root()](
                       const Progress&) { return root.empty() ? Left() : left_workspaces(root); },
                   [this](Left left) {
                     left_ = std::move(left);
                     std::ranges::reverse(left_);
                     offerNext();
                   });
}

void SessionRecovery::offerNext() {
  if (left_.empty()) {
    bench_.frame.settle();
    return;
  }
  const LeftWorkspace left = left_.back();
  left_.pop_back();
  bar_->showMessage(
      Severity::Warning,
      tr("Episcope ended unexpectedly (%1). What was open can be recovered: light fields: %2, "
         "results: %3.")
          .arg(short_text(left.last_change))
          .arg(left.project.scenes.size())
          .arg(result_count(left.project)),
      {tr("Recover"), [this, left] { recover(left); }}, {tr("Discard"), [this, left] {
                                                           discard_workspace(left.folder);
                                                           offerNext();
                                                         }});
}

void SessionRecovery::recover(const LeftWorkspace& left) {
  bench_.guards.leave(Leaving::Session, [this, left] { takeOver(left); });
}

void SessionRecovery::takeOver(const LeftWorkspace& left) {
  using Read = std::shared_ptr<ReadProject>;
  job_.start<Read>(
      [project = left.project, journals = bench_.document.journalFolder()](const Progress&) {
        auto read = std::make_shared<ReadProject>();
        read->project = project;
        if (!journals.empty()) name_journals(*read, journals);
        read_strokes(*read);
        return read;
      },
      [this, left](const Read& read) {
        const std::filesystem::path saved_as = read->project.saved_as;
        try {
          autosave_.takeOver(left.folder);
        } catch (const IoError& error) {
          bench_.messages.warn(QString::fromUtf8(error.what()));
          return;
        }
        const auto kept = show_project(bench_, std::move(*read), ProjectOrigin::Crash);
        autosave_.setProjectFile(saved_as);
        for (const std::filesystem::path& each : kept) {
          // What lies elsewhere is of a project of the user's.
          if (each.parent_path() == bench_.document.journalFolder()) discard_journal(each);
        }
        bench_.messages.success(tr("Recovered what was open."));
        offerNext();
      });
}

}  // namespace episcope

#include "moc_session_recovery.cpp"
