(** * Sums, powers modulo a polynomial, and the maps of a method as sums *)

From Coq Require Import QArith List Arith Lia.
From Gark Require Import Stages Methods.
Import ListNotations.
Open Scope Q_scope.

Definition sum {X} (xs : list X) (f : X -> Q) := fold_right Qplus 0 (map f xs).

Lemma sum_ext {X} (xs : list X) f g : (forall a, In a xs -> f a == g a) -> sum xs f == sum xs g.
Proof.
  unfold sum. induction xs as [|a xs IH]; simpl; intros H; [reflexivity|].
  rewrite (H a (or_introl eq_refl)), IH; [reflexivity|]. intros; apply H; right; assumption.
Qed.
Lemma sum_plus {X} (xs : list X) f g : sum xs (fun a => f a + g a) == sum xs f + sum xs g.
Proof. unfold sum. induction xs; simpl; [reflexivity|]. rewrite IHxs. ring. Qed.
Lemma sum_times {X} (xs : list X) c f : sum xs (fun a => c * f a) == c * sum xs f.
Proof. unfold sum. induction xs; simpl; [ring|]. rewrite IHxs. ring. Qed.
Lemma sum_one {X} (a : X) f : sum [a] f == f a.
Proof. unfold sum. simpl. ring. Qed.
Lemma sum_app {X} (xs ys : list X) f : sum (xs ++ ys) f == sum xs f + sum ys f.
Proof. unfold sum. induction xs; simpl; [ring|]. rewrite IHxs. ring. Qed.
Lemma sum_zero {X} (xs : list X) f : (forall a, In a xs -> f a == 0) -> sum xs f == 0.
Proof.
  intros H. rewrite (sum_ext _ _ (fun _ => 0 * 0)) by (intros; rewrite H by assumption; ring).
  rewrite sum_times. apply Qmult_0_l.
Qed.
(** Entry i of a sum of multiples of x: what moves up, and what the polynomial takes away. *)
Lemma sum_shifted {X} (xs : list X) i f c g :
  sum xs (fun a => (if Nat.eqb i 0 then 0 else f a) + c * g a)
  == (if Nat.eqb i 0 then 0 else sum xs f) + c * sum xs g.
Proof.
  rewrite sum_plus, sum_times. apply Qplus_comp; [|reflexivity].
  destruct (Nat.eqb i 0); [|reflexivity]. apply sum_zero. reflexivity.
Qed.
Lemma sum_map {X Y} (g : X -> Y) xs f : sum (map g xs) f == sum xs (fun a => f (g a)).
Proof. unfold sum. rewrite map_map. reflexivity. Qed.

Lemma sum_pairs {X Y} (xs : list X) (ys : list Y) f :
  sum (list_prod xs ys) f == sum xs (fun a => sum ys (fun c => f (a, c))).
Proof.
  induction xs as [|a xs IH]; [reflexivity|].
  simpl list_prod. rewrite sum_app, IH, sum_map. reflexivity.
Qed.
Lemma sum_swap {X Y} (xs : list X) (ys : list Y) f :
  sum xs (fun a => sum ys (fun c => f a c)) == sum ys (fun c => sum xs (fun a => f a c)).
Proof.
  induction xs as [|a xs IH].
  - symmetry. apply sum_zero. reflexivity.
  - change (sum ys (fun c => f a c) + sum xs (fun a => sum ys (fun c => f a c))
      == sum ys (fun c => f a c + sum xs (fun a => f a c))).
    rewrite sum_plus, IH. reflexivity.
Qed.
Lemma sum_of_products {X Y} (xs : list X) (ys : list Y) f g :
  sum (list_prod xs ys) (fun p => f (fst p) * g (snd p)) == sum xs f * sum ys g.
Proof.
  rewrite sum_pairs. simpl. transitivity (sum xs (fun a => sum ys g * f a)).
  - apply sum_ext. intros a _. rewrite sum_times. ring.
  - rewrite sum_times. ring.
Qed.
Lemma sum_at n i f : (i < n)%nat ->
  sum (seq 0 n) (fun a => (if Nat.eqb a i then 1 else 0) * f a) == f i.
Proof.
  intros H. induction n; [lia|]. rewrite seq_S, sum_app. unfold sum at 2. simpl.
  destruct (Nat.eqb_spec n i) as [->|D].
  - rewrite sum_zero; [ring|]. intros a I. apply in_seq in I. destruct (Nat.eqb_spec a i); [lia|ring].
  - rewrite IHn by lia. ring.
Qed.

(** ** Powers modulo a polynomial *)

Lemma nth_of_first {X} (xs : list X) n i x : (i < n)%nat -> nth i (firstn n xs) x = nth i xs x.
Proof.
  revert n i. induction xs as [|a xs IH]; intros [|n] [|i] H; simpl; try lia; try reflexivity.
  apply IH. lia.
Qed.

Lemma removelast_length (r : list Q) : length (removelast r) = (length r - 1)%nat.
Proof.
  induction r as [|a [|c r] IH]; [reflexivity|reflexivity|].
  change (S (length (removelast (c :: r))) = S (length r)). rewrite IH. simpl. lia.
Qed.
Lemma times_x_length m r : length r = length m -> length (times_x m r) = length m.
Proof.
  intros R. unfold times_x. rewrite map_length, combine_length. cbn [length].
  rewrite removelast_length. lia.
Qed.
Lemma power_length m n : length (power m n) = length m.
Proof.
  induction n; cbn [power]; [|apply times_x_length, IHn].
  rewrite firstn_length. simpl. rewrite repeat_length. lia.
Qed.

Lemma power_0 m i : (i < length m)%nat -> nth i (power m 0) 0 == if Nat.eqb i 0 then 1 else 0.
Proof.
  intros H. cbn [power]. rewrite nth_of_first by exact H.
  destruct i; [reflexivity|]. cbn [nth Nat.eqb]. rewrite nth_repeat. reflexivity.
Qed.

Lemma nth_removelast (r : list Q) i : (S i < length r)%nat -> nth i (removelast r) 0 = nth i r 0.
Proof.
  revert i. induction r as [|a r IH]; [simpl; lia|].
  destruct r as [|c r]; [simpl; lia|]. intros [|i] H; [reflexivity|].
  change (nth i (removelast (c :: r)) 0 = nth i (c :: r) 0). apply IH. simpl in *. lia.
Qed.
Lemma last_nth (r : list Q) : last r 0 = nth (length r - 1) r 0.
Proof.
  induction r as [|a r IH]; [reflexivity|]. destruct r as [|c r]; [reflexivity|].
  change (last (c :: r) 0 = nth (length r) (c :: r) 0).
  rewrite IH. f_equal. simpl. lia.
Qed.

Lemma times_x_at m r i : length r = length m -> (i < length m)%nat -> nth i (times_x m r) 0 ==
  (if Nat.eqb i 0 then 0 else nth (i - 1) r 0) - nth (length m - 1) r 0 * nth i m 0.
Proof.
  intros R H. unfold times_x. rewrite last_nth, R.
  set (f := fun '(a, c) => Qred (a - nth (length m - 1) r 0 * c)).
  assert (L : length (0 :: removelast r) = length m) by (simpl; rewrite removelast_length; lia).
  rewrite nth_indep with (d' := f (0, 0)) by (rewrite map_length, combine_length, L; lia).
  rewrite map_nth, combine_nth by exact L. unfold f. rewrite Qred_correct.
  destruct i; [reflexivity|]. cbn [nth Nat.eqb]. replace (S i - 1)%nat with i by lia.
  rewrite nth_removelast; [reflexivity|]. lia.
Qed.

Lemma power_S m n i : (i < length m)%nat -> nth i (power m (S n)) 0 ==
  (if Nat.eqb i 0 then 0 else nth (i - 1) (power m n) 0)
  - nth (length m - 1) (power m n) 0 * nth i m 0.
Proof. intros H. apply times_x_at; [apply power_length|exact H]. Qed.

Lemma power_small m n i : (n < length m)%nat -> (i < length m)%nat ->
  nth i (power m n) 0 == if Nat.eqb i n then 1 else 0.
Proof.
  revert i. induction n; intros i Hn H; [apply power_0, H|].
  rewrite power_S by exact H. rewrite (IHn (length m - 1)%nat) by lia.
  destruct (Nat.eqb_spec (length m - 1) n); [lia|].
  destruct (Nat.eqb_spec i 0) as [->|D]; [simpl; ring|].
  rewrite IHn by lia. replace (Nat.eqb (i - 1) n) with (Nat.eqb i (S n)); [ring|].
  apply Bool.eq_true_iff_eq. rewrite !Nat.eqb_eq. lia.
Qed.

(** ** Products *)

(** ** Products and blocks of a method *)

Lemma nth_flat {X Y} (f : X -> list Y) d xs i e x y : (forall x, length (f x) = d) -> (e < d)%nat ->
  (i < length xs)%nat \/ nth e (f x) y = y ->
  nth (i * d + e) (flat_map f xs) y = nth e (f (nth i xs x)) y.
Proof.
  intros L He. revert i. induction xs as [|a xs IH]; intros i H.
  - destruct H as [H|H]; [simpl in H; lia|].
    replace (nth i [] x) with x by (destruct i; reflexivity). rewrite H.
    destruct (i * d + e)%nat; reflexivity.
  - cbn [flat_map]. destruct i.
    + rewrite app_nth1 by (rewrite L; exact He). reflexivity.
    + rewrite app_nth2 by (rewrite L; simpl; lia). rewrite L.
      replace (S i * d + e - d)%nat with (i * d + e)%nat by (simpl; lia). apply IH.
      destruct H as [H|H]; [left; simpl in H; lia|right; exact H].
Qed.

Lemma nth_entry {X} n d (i e : nat) (f : nat * nat -> X) x : (i < n)%nat -> (e < d)%nat ->
  nth (i * d + e) (map f (list_prod (seq 0 n) (seq 0 d))) x = f (i, e).
Proof.
  intros Hi He. assert (G : forall k, nth (i * d + e) (map f (list_prod (seq k n) (seq 0 d)))
    x = f ((k + i)%nat, e)).
  { clear - Hi He. revert i Hi. induction n; [lia|]. intros i Hi k. cbn [seq list_prod].
    rewrite map_app, map_map. destruct i.
    - rewrite app_nth1 by (rewrite map_length, seq_length; lia). simpl.
      rewrite nth_indep with (d' := f (k, O)) by (rewrite map_length, seq_length; lia).
      rewrite (map_nth (fun y => f (k, y))), seq_nth by lia. rewrite Nat.add_0_r. reflexivity.
    - rewrite app_nth2 by (rewrite map_length, seq_length; simpl; lia).
      rewrite map_length, seq_length. replace (S i * d + e - d)%nat with (i * d + e)%nat by (simpl;
        lia).
      rewrite IHn by lia. f_equal. f_equal. lia. }
  rewrite (G 0%nat). reflexivity.
Qed.

Lemma bil_sum {X} (ps : list X) (f g : X -> nat) q x y :
  bil (nonzero (map (fun p => (f p, g p, Qred (q p))) ps)) x y ==
    sum ps (fun p => q p * x (f p) * y (g p)).
Proof.
  unfold sum. induction ps as [|p ps IH]; [reflexivity|]. cbn [map nonzero filter fold_right].
  cbn [snd]. rewrite <- IH. destruct (Qeq_bool (Qred (q p)) 0) eqn:E; cbn [negb bil].
  - apply Qeq_bool_iff in E. rewrite Qred_correct in E. rewrite E. unfold nonzero. ring.
  - unfold nonzero. rewrite Qred_correct. reflexivity.
Qed.

Section Maps.
Variable M : method.

Definition space_at l := the_space M (space_of M l).
Definition dim l := (size_of (space_at l) * degree M)%nat.

Lemma mu_at l x y i e : (i < size_of (space_at l))%nat -> (e < degree M)%nat ->
  mul (Pof M l) x y (entry M (i, e)) ==
  sum (list_prod (every M (space_at l)) (every M (space_at l))) (fun p =>
    in_space (space_at l) i (fst (fst p)) (fst (snd p)) * in_field M e (snd (fst p)) (snd (snd p))
    * x (entry M (fst p)) * y (entry M (snd p))).
Proof.
  intros Hi He. unfold mul, Pof, product_of, every, entry. cbn [fst snd].
  rewrite nth_entry by assumption. unfold product_row. cbn [fst snd].
  rewrite (map_ext _ (fun p => (entry M (fst p), entry M (snd p),
    Qred (in_space (space_at l) i (fst (fst p)) (fst (snd p)) * in_field M e (snd (fst p))
      (snd (snd p)))))).
  - rewrite bil_sum. reflexivity.
  - intros [[a u] [c v]]. reflexivity.
Qed.

Lemma times_is x y e : times M x y e =
  sum (seq 0 (degree M)) (fun u => sum (seq 0 (degree M)) (fun v => in_field M e u v * x u * y v)).
Proof. reflexivity. Qed.
Lemma times_ext x x' y y' e : (forall u, (u < degree M)%nat -> x u == x' u) ->
  (forall v, (v < degree M)%nat -> y v == y' v) -> times M x y e == times M x' y' e.
Proof.
  intros Hx Hy. rewrite !times_is. apply sum_ext. intros u Hu. apply sum_ext. intros v Hv.
  apply in_seq in Hu, Hv. rewrite (Hx u), (Hy v) by lia. reflexivity.
Qed.

Lemma times_zero x y e : (forall u, (u < degree M)%nat -> x u == 0) \/
  (forall v, (v < degree M)%nat -> y v == 0) -> times M x y e == 0.
Proof.
  intros Z. rewrite times_is. apply sum_zero. intros u Hu. apply sum_zero. intros v Hv.
  apply in_seq in Hu, Hv. destruct Z as [Z|Z]; [rewrite (Z u) by lia|rewrite (Z v) by lia]; ring.
Qed.

(** Entry i of a stage value, a number. *)
Definition number_at (x : V) i : V := fun e => x (entry M (i, e)).

Lemma mu_is l x y i e : (i < size_of (space_at l))%nat -> (e < degree M)%nat ->
  mul (Pof M l) x y (entry M (i, e)) ==
  sum (seq 0 (size_of (space_at l))) (fun a => sum (seq 0 (size_of (space_at l))) (fun c =>
    in_space (space_at l) i a c * times M (number_at x a) (number_at y c) e)).
Proof.
  intros Hi He. rewrite mu_at by assumption. unfold every. rewrite !sum_pairs. apply sum_ext.
  intros a _.
  transitivity (sum (seq 0 (degree M)) (fun u => sum (seq 0 (size_of (space_at l))) (fun c =>
    sum (seq 0 (degree M)) (fun v => in_space (space_at l) i a c * (in_field M e u v
      * number_at x a u * number_at y c v))))).
  - apply sum_ext. intros u _. rewrite sum_pairs. apply sum_ext. intros c _. apply sum_ext.
    intros v _. cbn [fst snd]. unfold number_at. ring.
  - rewrite sum_swap. apply sum_ext. intros c _. rewrite times_is, <- sum_times.
    apply sum_ext. intros u _. rewrite <- sum_times. reflexivity.
Qed.

(** At points products are those of numbers. *)
Lemma mu_at_points l s x y i e : space_at l = Points s -> (i < s)%nat -> (e < degree M)%nat ->
  mul (Pof M l) x y (entry M (i, e)) == times M (number_at x i) (number_at y i) e.
Proof.
  intros Sp Hi He. rewrite mu_is by (rewrite ?Sp; assumption). rewrite Sp. cbn [size_of].
  rewrite (sum_ext _ _ (fun a => (if Nat.eqb a i then 1 else 0) *
    times M (number_at x i) (number_at y i) e)).
  - rewrite sum_at by exact Hi. reflexivity.
  - intros a _. rewrite (sum_ext _ _ (fun c => (if Nat.eqb c i then 1 else 0) *
      ((if Nat.eqb a i then 1 else 0) * times M (number_at x a) (number_at y i) e))).
    + rewrite sum_at by exact Hi. destruct (Nat.eqb_spec a i) as [->|]; [reflexivity|ring].
    + intros c _. cbn [in_space]. rewrite (Nat.eqb_sym i a), (Nat.eqb_sym i c).
      destruct (Nat.eqb a i), (Nat.eqb_spec c i) as [->|]; simpl; ring.
Qed.

Lemma mu_beyond l x y n : (dim l <= n)%nat -> mul (Pof M l) x y n == 0.
Proof.
  intros H. unfold mul, Pof. rewrite nth_overflow; [reflexivity|].
  unfold product_of, every. rewrite map_length, prod_length, !seq_length. exact H.
Qed.

Lemma entry_of n s : (n < s * degree M)%nat ->
  exists i e, (i < s)%nat /\ (e < degree M)%nat /\ n = entry M (i, e).
Proof.
  unfold entry. intros H.
  assert (degree M <> 0)%nat by (intros E; rewrite E in H; lia).
  exists (n / degree M)%nat, (n mod degree M)%nat. cbn [fst snd]. split; [|split].
  - apply Nat.div_lt_upper_bound; lia.
  - apply Nat.mod_upper_bound. assumption.
  - rewrite Nat.mul_comm. apply Nat.div_mod. assumption.
Qed.

Lemma lin_nonzero ts v : lin (nonzero ts) v == lin ts v.
Proof.
  unfold nonzero. induction ts as [|[j q] ts IH]; [reflexivity|]. cbn [filter snd].
  destruct (Qeq_bool q 0) eqn:E; cbn [negb lin]; rewrite IH; [|reflexivity].
  apply Qeq_bool_iff in E. rewrite E. ring.
Qed.
Lemma lin_app ts us v : lin (ts ++ us) v == lin ts v + lin us v.
Proof. induction ts as [|[j q] ts IH]; simpl; [ring|]. rewrite IH. ring. Qed.
Lemma lin_map {X} (f : X -> nat) q xs v :
  lin (map (fun a => (f a, q a)) xs) v == sum xs (fun a => q a * v (f a)).
Proof. unfold sum. induction xs; simpl; [reflexivity|]. rewrite IHxs. reflexivity. Qed.

(** Σ row_j x_j. *)
Lemma row_is row x e : lin (block_row M row e) x ==
  sum (seq 0 (length row)) (fun j => times M (fun w => nth w (nth j row []) 0) (number_at x j) e).
Proof.
  unfold block_row. rewrite lin_nonzero.
  assert (G : forall row k, lin (flat_map (fun '(j, x) =>
      map (fun u => (entry M (j, u), coefficient M x e u)) (seq 0 (degree M)))
      (combine (seq k (length row)) row)) x ==
    sum (seq 0 (length row)) (fun j => times M (fun w => nth w (nth j row []) 0)
      (number_at x (k + j)) e)).
  { clear row. induction row as [|a row IH]; intros k; [reflexivity|].
    cbn [length seq combine flat_map]. rewrite lin_app, IH, <- seq_shift.
    change (0%nat :: map S (seq 0 (length row))) with ([0%nat] ++ map S (seq 0 (length row))).
    rewrite sum_app, sum_one, sum_map. apply Qplus_comp.
    - rewrite lin_map. rewrite times_is, sum_swap. apply sum_ext. intros u _.
      unfold coefficient. rewrite Qred_correct. rewrite Nat.add_0_r.
      fold (sum (seq 0 (degree M)) (fun w => nth w a 0 * in_field M e w u)).
      rewrite Qmult_comm, <- sum_times. apply sum_ext. intros w _. unfold number_at. simpl nth.
      ring.
    - apply sum_ext. intros j _. rewrite Nat.add_succ_r. reflexivity. }
  apply G.
Qed.

Lemma row_of_block A i e : (e < degree M)%nat ->
  nth (entry M (i, e)) (rows_of M A) [] = block_row M (nth i A []) e.
Proof.
  intros He. assert (At : forall row, nth e (map (block_row M row) (seq 0 (degree M))) [] =
    block_row M row e).
  { intros row. rewrite nth_indep with (d' := block_row M row 0%nat)
      by (rewrite map_length, seq_length; exact He).
    rewrite map_nth, seq_nth by exact He. reflexivity. }
  unfold entry, rows_of. cbn [fst snd]. rewrite (nth_flat _ (degree M) A i e [] []).
  - apply At.
  - intros row. rewrite map_length. apply seq_length.
  - exact He.
  - right. rewrite At. reflexivity.
Qed.

(** ** What these maps look at *)

Definition local n (f : V -> Q) := forall x y, (forall j, (j < n)%nat -> x j == y j) -> f x == f y.

Lemma row_local row e n : (length row * degree M <= n)%nat -> local n (lin (block_row M row e)).
Proof.
  intros H x y E. rewrite !row_is. apply sum_ext. intros j Hj. apply in_seq in Hj.
  apply times_ext; [reflexivity|]. intros v Hv. apply E. unfold entry. cbn [fst snd]. nia.
Qed.
Lemma A_local l m i : (forall A, block M (space_of M l) m = Some A -> forall row, In row A ->
    (length row <= size_of (space_at m))%nat) ->
  local (dim m) (fun x => app (Aof M l m) x i).
Proof.
  intros H. unfold app, Aof, rows. destruct (block M (space_of M l) m) as [A|] eqn:E.
  - destruct (nth_in_or_default i (rows_of M A) []) as [I|I].
    2:{ intros x y _. rewrite I. reflexivity. }
    revert I. generalize (nth i (rows_of M A) []) as ts. intros ts I.
    unfold rows_of in I. apply in_flat_map in I. destruct I as [row [R I]].
    apply in_map_iff in I. destruct I as [e [<- _]]. apply (row_local row e).
    specialize (H A eq_refl row R). unfold dim. nia.
  - replace (nth i [] []) with (@nil (nat * Q)) by (destruct i; reflexivity). intros x y _.
    reflexivity.
Qed.
Lemma mu_below l x x' y y' :
  (forall n, (n < dim l)%nat -> x n == x' n) -> (forall n, (n < dim l)%nat -> y n == y' n) ->
  veq (mul (Pof M l) x y) (mul (Pof M l) x' y').
Proof.
  intros Hx Hy n. destruct (lt_dec n (dim l)) as [L|L].
  - destruct (entry_of n _ L) as [i [e [Hi [He ->]]]]. rewrite !mu_is by assumption.
    apply sum_ext. intros a Ha. apply sum_ext. intros c Hc. apply in_seq in Ha, Hc.
    apply Qmult_comp; [reflexivity|].
    apply times_ext; intros u Hu; [apply Hx|apply Hy]; unfold entry, dim; cbn [fst snd]; nia.
  - rewrite !mu_beyond by lia. reflexivity.
Qed.
End Maps.
