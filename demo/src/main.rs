//! The demo of Muslin as a program: it opens a window, or writes a picture with `--shot`.

#[cfg(not(target_arch = "wasm32"))]
fn main() -> std::process::ExitCode {
    use muslin_demo::app::App;
    use muslin_demo::cli::{self, Task};
    use muslin_demo::native;
    use muslin_demo::native::receipt_window::ReceiptWindow;
    use muslin_demo::native::window_app::ClothWindow;
    use muslin_demo::receipt::ReceiptApp;
    use std::process::ExitCode;

    let run = || -> Result<(), Box<dyn std::error::Error>> {
        match cli::parse(std::env::args().skip(1))? {
            Task::Help => println!("{}", cli::USAGE),
            Task::Web => return Err("--web needs the page built: cargo xtask demo --web".into()),
            Task::Shot(file, shot) => {
                let picture = shot.take()?;
                picture.save(&file)?;
                for time in picture.times {
                    println!("{:12} {:7.3} ms", time.name, time.milliseconds);
                }
                if let Some((driver, rate)) = picture.rate {
                    println!("{rate:.1} frames a second on {driver}");
                }
            }
            Task::ClothWindow(values) => {
                let mut settings = native::settings_file::read();
                cli::apply(&values, &mut settings);
                native::run(ClothWindow::new(App::new(settings, native::clock)?))?;
            }
            Task::ReceiptWindow(receipt) => {
                let app = ReceiptApp::new(receipt.settings, receipt.small, native::clock)?;
                native::run(ReceiptWindow::new(app))?;
            }
        }
        Ok(())
    };
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

/// Empty: the page loads the library instead of this program.
#[cfg(target_arch = "wasm32")]
fn main() {}
